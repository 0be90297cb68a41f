model slider
parameter mu = -0.3
parameter N = 9.8
state v = 1
force F = mu*N*sgn(v)
der(v) = -F
