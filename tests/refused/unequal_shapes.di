model slider
state p[2] = [0, 0]
state v[2] = [1, 0]
der(p) = v
der(v) = -sgn(v) - 9.8
