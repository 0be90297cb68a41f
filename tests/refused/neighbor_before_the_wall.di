model chain
constant n = 3
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = (if i < n then x[i+1] else 0) - x[i-1]
