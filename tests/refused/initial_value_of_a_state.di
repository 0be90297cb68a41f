model falling
state p = 1
state v = -2*p
der(p) = v
der(v) = -9.8
