model m
parameter K = 4.9e-324
