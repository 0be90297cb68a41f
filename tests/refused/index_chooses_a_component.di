model point
state p[3] = [0, 0, 0]
state x[i in 1..3] = 0
der(p) = [1, 2, 3]
for i in 1..3: der(x[i]) = p[i]
