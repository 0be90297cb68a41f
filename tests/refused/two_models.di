model m
state p = 0
der(p) = 0
model n
