model m
state p = 1
p' = -p
