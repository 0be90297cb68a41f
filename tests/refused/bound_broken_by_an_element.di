model row
constant n = 3
parameter F0[i in 1..n] = [1, -2, 3] {N} >= 0
state v[i in 1..n] = 1
for i in 1..n: der(v[i]) = -F0[i]*sgn(v[i])
