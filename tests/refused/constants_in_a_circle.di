model chain
constant n = m - 1
constant m = n + 1
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = -x[i]
