model bouncing
state p = 1
state v = 0
force N = dio(p)
der(p) = v
der(v) = N - 9.8
approximate N: K = 1e5, alpha = 5e-3, beta = 4e-3
