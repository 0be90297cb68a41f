model m
parameter mode = "fast"
state p = 1
der(p) = -p
