model slider
state v = 1
force F = sgn(v)
der(v) = -F
approximate F: K = 1e5, beta = 4e-3
approximate F: K = 2e5, beta = 2e-3
