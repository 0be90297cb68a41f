# Two blocks, a wall and a conveyor: three contacts with friction that act on each
# other (paper, Example II, Section 5.2).
#
# Block 1 hangs on a spring and may touch the wall; block 2 stands on the conveyor and
# is carried into block 1. The step is half of the paper's: at 1 ms the set where
# block 1 sticks on both sides lies beyond the limit of RK4 (7.0e-4 s).
model two_blocks_conveyor

parameter M1  = 0.5  {kg}
parameter M2  = 1    {kg}
parameter Ks  = 100  {N/m}      # spring of block 1
parameter mu1 = 0.5             # wall and block 1
parameter mu2 = 0.5             # block 1 and block 2
parameter mu3 = 0.5             # block 2 and conveyor
parameter u   = 1    {m/s}      # speed of the conveyor, toward block 1
parameter g   = 9.8  {m/s^2}

# Block 1 is at zero where it touches the wall and the spring carries its weight;
# block 2 where it stands on the conveyor and touches block 1 there.
state p1[2] = [0, 0.25]  {m}
state p2[2] = [0.05, 0]  {m}
state v1[2] = [0, 0]     {m/s}
state v2[2] = [0, 0]     {m/s}

force N1 = dio(p1.x)          {N}     # wall on block 1
force N2 = dio(p2.x - p1.x)   {N}     # block 1 on block 2
force N3 = dio(p2.y)          {N}     # conveyor on block 2

force F1 = mu1*N1*sgn(v1.y)         {N}
force F2 = mu2*N2*sgn(v1.y - v2.y)  {N}
force F3 = mu3*N3*sgn(v2.x + u)     {N}

der(p1) = v1
der(p2) = v2
M1*der(v1) = [N1 - N2, -F1 - F2 - Ks*p1.y]
M2*der(v2) = [N2 - F3, F2 + N3 - M2*g]

approximate N1, N2, N3: K = 5e5 {N/m}, beta = 2e-3 {s}, alpha = 1.6e-3 {s}
approximate F1, F2, F3: K = 5e5 {N/m}, beta = 2e-3 {s}
simulate 2 {s} step 5e-4 {s} method rk4
