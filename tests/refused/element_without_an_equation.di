model chain
constant n = 4
state x[i in 1..n] = 0
for i in 1..n-1: der(x[i]) = x[i+1] - x[i]
