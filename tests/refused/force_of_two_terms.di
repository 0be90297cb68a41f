model shaft
state p = 0
state v = 1
force F = sgn(v) + dio(p)
der(p) = v
der(v) = -F
