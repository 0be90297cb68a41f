model m
parameter M = 1
state v = 1
M*der(v) + v
