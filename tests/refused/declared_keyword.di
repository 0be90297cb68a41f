model m
state step = 1
parameter include = 2
