model slider
parameter mu = -0.3 {1} >= 0
state v = 1
der(v) = -9.8*mu*sgn(v)
