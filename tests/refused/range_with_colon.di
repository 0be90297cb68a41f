model m
constant n = 3
state x[i in 1:n] = 0
