model m
state p = 1
der(p) = -|p|
