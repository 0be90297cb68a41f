model slider
state v[2] = [1, 0]
der(v) = -[2, 1]*sgn(v)
