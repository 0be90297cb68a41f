model slider
state v = 1
der(v) = -sgn(v)
approximate default sgn: K = 1e5, beta = 4e-3
approximate default sgn: K = 2e5, beta = 4e-3
