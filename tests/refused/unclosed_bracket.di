model m
state p[3] = [0, 0, 1
state v = 1
der(p) = [0, 0, 0]
der(v) = 0
