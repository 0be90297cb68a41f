model m
state p = 1
force N = dio(p)
der(p) = N
approximate N: K = 1e5 beta = 4e-3
