model block
parameter mu = 0.3
state p = 0
state v = 0
force N = dio(p)
force F = mu*N*sgn(v)
der(p) = v
der(v) = N - F - 9.8
approximate N: K = 1e5, alpha = 2e-3, beta = 4e-3, at equilibrium
approximate F: K = 1e5, beta = 4e-3, at equilibrium
