model m
state p[2] = [0, 0]
der(p) = p.1*[1, 1]
