model m
parameter M = 2
state p = 1
der(p) = -2M*p
der(p) = -M p
der(p) = 2(p + 1)
