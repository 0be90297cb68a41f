model falling
state p = 1
state v = 0
force spring = -100*p
der(p) = v
der(v) = spring - 9.8
