model row
state v[i in 1..2] = 1
force F[i in 1..2] = sgn(v[i])
for i in 1..2: der(v[i]) = -F[i]
approximate F[1]: K = 100, beta = 0.1
