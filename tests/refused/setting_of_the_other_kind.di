model slider
state v = 1
force F = sgn(v)
der(v) = -F
approximate F: K = 1e5, alpha = 2e-3, bta = 4e-3
