model chain
constant n = 4
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = -x[i]
der(x[2]) = 0
