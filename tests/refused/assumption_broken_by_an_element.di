model row
constant n = 3
parameter static[i in 1..n] = [3, 2, 1]
parameter kinetic = 1.5
state v[i in 1..n] = 1
for i in 1..n: assume static[i] >= kinetic
for i in 1..n: der(v[i]) = -(static[i] - kinetic)*sgn(v[i])
