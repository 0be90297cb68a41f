model cart
constant n = 3
state v = 0
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = v
for i in 1..n: der(v) = -x[i]
