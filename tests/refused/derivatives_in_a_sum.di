model chain
constant n = 3
state x[i in 1..n] = 0
state v = 0
for i in 1..n: der(x[i]) = v
der(v) = -sum(i in 1..n: der(x[i]))
