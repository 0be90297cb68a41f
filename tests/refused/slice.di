model m
state x[3] = [1, 2, 3]
der(x) = x[1..2]
