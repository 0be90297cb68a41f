model m
parameter K = 1.2.3
