model fall
parameter g = 9.81 {m/s²}
parameter k = 3 {N.m}
parameter phi = 20 {°}
state v = 0
der(v) = g*k*phi
