model m
constant n = 3
for i in 1..n: let y = 2*i
