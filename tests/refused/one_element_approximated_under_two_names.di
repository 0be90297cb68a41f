model bouncing
state p = 1
state v = 0
force N = dio(p)
force P = dio(2*p)
der(p) = v
der(v) = N + P - 9.8
approximate N: K = 1e5, alpha = 2e-3, beta = 4e-3
approximate P: K = 2e5, alpha = 2e-3, beta = 4e-3
