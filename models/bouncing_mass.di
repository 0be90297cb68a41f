# A mass dropped on a rigid floor (paper, Section 4.2, equation (27), Figure 5).
#
# alpha/beta sets how much of the speed comes back: 1 returns all of it, smaller
# ratios return less. Try -p f.alpha=1e-3.
model bouncing_mass

parameter M  = 1    {kg}
parameter fe = -9.8 {N}         # the external force, here the weight

state p = 1  {m}
state v = 0  {m/s}

force f = dio(p)  {N}           # pushes while p = 0, zero while p > 0

der(p) = v
M*der(v) = fe + f

approximate f: K = 1e5 {N/m}, beta = 1e-2 {s}, alpha = 5e-3 {s}
simulate 3 {s} step 1e-3 {s} method rk4
