model m
state p, v = 0
