model m
state p = 1
der(p) = p > 0 ? -1 : 1
