parameter M = 1
model m
state p = 0
der(p) = 0
