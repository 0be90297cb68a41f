model m
state p[2] = (0, 1)
der(p) = [0, 0]
