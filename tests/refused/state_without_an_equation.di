model falling
state p = 1
state v = 0
force N = dio(p)
der(v) = N - 9.8
approximate N: K = 1e5, alpha = 1e-3, beta = 2e-3
