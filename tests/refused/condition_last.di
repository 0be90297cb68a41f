model m
state p = 1
der(p) = -1 if p > 0 else 1
