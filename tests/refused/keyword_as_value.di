model m
state p = 1
der(p) = 2*state
