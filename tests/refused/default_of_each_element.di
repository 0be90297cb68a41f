model driven
constant n = 3
input load[i in 1..n] = 2*i
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = load[i]
