model m
parameter M = 1
