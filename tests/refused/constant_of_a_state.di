model slider
state v = 1
force F = sgn(v)
der(v) = -F
approximate F: K = 1e3*v, beta = 1e-3
