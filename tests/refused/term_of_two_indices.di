model stack
constant n = 3
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = sum(j in 1..n: dio(x[i] - x[j]))
