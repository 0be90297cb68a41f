model chain
constant n = 3
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = x[2*i]
