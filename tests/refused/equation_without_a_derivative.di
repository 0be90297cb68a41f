model falling
state p = 1
state v = 0
der(p) = v
v = -9.8*t
