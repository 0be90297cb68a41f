model chain
constant n = 3
state x[i in 1..n] = 0
der(x[1]) = 1
for i in 2..n: der(x[i]) = der(x[i-1]) + x[i]
