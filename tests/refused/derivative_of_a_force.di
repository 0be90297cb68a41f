model bouncing
state p = 1
state v = 0
der(p) = v
der(v) = -9.8 + der(dio(p))
