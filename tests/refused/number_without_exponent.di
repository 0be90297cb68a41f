model m
parameter K = 1e
