model row
constant n = 3
state v[i in 1..n] = 1
for i in 1..n: der(v[i]) = -v[i]*sgn(v[i])
