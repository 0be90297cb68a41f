model chain
constant n = 3
parameter stiffness[i in 0..n] = 1/i
state x[i in 1..n] = 0
for i in 1..n: der(x[i]) = -stiffness[i]*x[i]
