model chain
constant n = 3
state i = 0
state x[k in 1..n] = 0
for i in 1..n: der(x[i]) = -x[i]
der(i) = 1
