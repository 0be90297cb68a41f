model row
state v[i in 1..2] = 1
for i in 1..2: der(v[i]) = -v[i]
assume v[i] >= 0 for i in 1..2
