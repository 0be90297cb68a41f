# A sphere that falls, bounces, slips and finally rolls (paper, Example I, Section 5.1).
#
# Friction turns sliding into rolling: whatever mu, and however often it bounces, the
# sphere ends up rolling at 5/7 of the speed it came with.
model rolling_sphere

parameter M  = 1    {kg}
parameter R  = 0.5  {m}
parameter mu = 0.1
parameter g  = 9.8  {m/s^2}

state p[3] = [0, 0, 2*R]   {m}        # center
state v[3] = [5.5, 0, 0]   {m/s}
state w[3] = [0, 0, 0]     {rad/s}    # angular velocity, in the world frame
state q[4] = [1, 0, 0, 0]             # attitude, scalar first

let slip = [v.x - R*w.y, v.y + R*w.x] # velocity of the lowest point, equation (34)

force N = dio(p.z - R)       {N}      # normal force of the floor
force F = mu*N*sgn(slip)     {N}      # friction, two components

let f = [-F.x, -F.y, N]               # force of the floor on the sphere

der(p) = v
M*der(v) = f - [0, 0, M*g]
2/5*M*R^2*der(w) = cross([0, 0, -R], f)
der(q) = 1/2*qmul([0, w], q)

output depth = max(0, R - p.z)  {m}   # how far the floor is pressed in

approximate N: K = 1e5 {N/m}, beta = 4e-3 {s}, alpha = 2.8e-3 {s}
approximate F: K = 1e5 {N/m}, beta = 4e-3 {s}
simulate 4 {s} step 1e-3 {s} method rk4
