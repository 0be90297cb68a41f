# The handle of a haptic device against a rigid virtual wall with friction.
#
# A hand pulls the handle through a spring-like arm toward a point behind the wall and
# drags it along. What the device must render is exactly the contact: it never pulls
# the hand in, and it holds the handle without creep while the arm drags too little.
model haptic_wall

parameter m  = 0.15  {kg}       # handle
parameter b  = 0.8   {N*s/m}    # damping of the mechanism
parameter k  = 250   {N/m}      # arm
parameter c  = 6     {N*s/m}
parameter mu = 0.4

input hand[2] = [-0.01, 0.004] {m}   # where the hand wants to be; the wall is at x = 0

state p[2] = [0.02, 0]  {m}
state v[2] = [0, 0]     {m/s}

force N = dio(p.x)          {N}
force F = mu*N*sgn(v.y)     {N}

let arm = k*(hand - p) - c*v

der(p) = v
m*der(v) = arm - b*v + [N, -F]

output felt[2] = [N, -F]  {N}

approximate N: K = 5e4 {N/m}, beta = 2e-3 {s}, alpha = 1e-3 {s}
approximate F: K = 5e4 {N/m}, beta = 2e-3 {s}
simulate 1 {s} step 1e-4 {s} method rk4
