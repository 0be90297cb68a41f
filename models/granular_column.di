# A column of n balls that falls on a floor and comes to rest under gravity.
#
# Each force acts between a ball and the one below it, the first between ball 1 and the
# floor: the `if` on the index is decided when the model is compiled.
model granular_column

constant n = 10

parameter m = 0.01  {kg}
parameter d = 0.02  {m}         # diameter
parameter g = 9.81  {m/s^2}

state z[i in 1..n] = d*(1.2*i - 0.5)  {m}
state v[i in 1..n] = 0                {m/s}

force N[i in 1..n] = dio(z[i] - (if i > 1 then z[i-1] + d else d/2))  {N}

for i in 1..n: der(z[i]) = v[i]
for i in 1..n: m*der(v[i]) = N[i] - (if i < n then N[i+1] else 0) - m*g

output height = z[n]  {m}
output energy = sum(i in 1..n: 1/2*m*v[i]^2 + m*g*z[i])  {J}

approximate N: K = 2e4 {N/m}, beta = 1e-3 {s}, alpha = 4e-4 {s}
simulate 1 {s} step 5e-5 {s} method rk4
