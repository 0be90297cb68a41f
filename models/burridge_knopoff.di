# A row of blocks between springs, dragged over a rough surface: the model of an
# earthquake fault by Burridge and Knopoff (1967). Blocks stick, load up, and slip in
# events of every size, from one block to the whole row.
#
# That takes friction which falls with the speed, here as Carlson and Langer (1989) have
# it: with a constant level the blocks slide along most of the time (try -p vc=1e9).
# Everything is a family over i: one line each, and one loop in the C, for any n.
model burridge_knopoff

constant n = 32

parameter m  = 1     {kg}
parameter kc = 40    {N/m}      # springs between neighbors
parameter kp = 10    {N/m}      # leaf springs to the plate that drags
parameter V  = 0.01  {m/s}      # speed of the plate
parameter vc = 0.1   {m/s}      # speed at which friction has fallen to a half
parameter F0[i in 1..n] = 2 + 0.5*sin(5*i)  {N}   # at rest; no two blocks are alike

state x[i in 1..n] = 0.02*sin(3*i)  {m}
state v[i in 1..n] = 0              {m/s}

let right[i in 1..n] = if i < n then x[i+1] - x[i] else 0  {m}
let left[i in 1..n]  = if i > 1 then x[i] - x[i-1] else 0  {m}

force F[i in 1..n] = F0[i]/(1 + abs(v[i])/vc)*sgn(v[i])  {N}

for i in 1..n: der(x[i]) = v[i]
for i in 1..n: m*der(v[i]) = kc*(right[i] - left[i]) + kp*(V*t - x[i]) - F[i]

output slip = sum(i in 1..n: v[i])/n  {m/s}

approximate F: K = 1e4 {N/m}, beta = 1e-2 {s}
simulate 60 {s} step 1e-3 {s} method rk4
