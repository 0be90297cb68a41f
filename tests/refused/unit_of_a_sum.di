model bouncing_mass
parameter M = 1 {kg}
parameter g = 9.8 {m/s^2}
state p = 1 {m}
state v = 0 {m/s}
force N = dio(p) {N}
der(p) = v
M*der(v) = N - g
