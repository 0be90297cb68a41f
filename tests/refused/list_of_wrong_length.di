model chain
constant n = 3
parameter rest[i in 1..n] = [0.1, 0.2]
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = rest[i] - x[i]
