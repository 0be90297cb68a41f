model m
parameter K = 0x10
