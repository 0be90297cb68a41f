model m
parameter größe = 1
