model m
state p = 1
state v = 1
der(p) = sin(v
der(v) = 0
