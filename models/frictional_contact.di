# A point mass that meets a rigid surface with dry friction (paper, Section 4.3,
# equations (28) and (29)). There is no gravity: it touches once and leaves again,
# slower along the surface than it came.
#
# The level of friction is mu times the normal force, so dio stands in the factor of
# sgn: it is replaced first, then sgn with its factor.
model frictional_contact

parameter M  = 1   {kg}
parameter mu = 0.3

state p[3] = [0, 0, 0.1]    {m}
state v[3] = [1, 0.5, -1]   {m/s}

force N = dio(p.z)                    {N}
force F = mu*N*sgn([v.x, v.y])        {N}

der(p) = v
M*der(v) = [-F.x, -F.y, N]

approximate N: K = 1e5 {N/m}, beta = 4e-3 {s}, alpha = 2.8e-3 {s}
approximate F: K = 1e5 {N/m}, beta = 4e-3 {s}
simulate 0.5 {s} step 1e-3 {s} method rk4
