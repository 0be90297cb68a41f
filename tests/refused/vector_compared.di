model fall
state v[2] = [1, 2]
assume v >= 0
der(v) = -v
