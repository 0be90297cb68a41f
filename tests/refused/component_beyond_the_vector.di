model point
state p[2] = [0, 0]
der(p) = [p[2], p[3]]
