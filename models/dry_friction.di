# A mass on a surface with dry friction, under a load that stays below the level of
# friction once it has come to rest (paper, Section 4.1, Figure 3).
#
# The load rises, starts the mass and then swings below 0.5 N: from there on a rigid
# friction law does not move at all. The ODE sticks without creep; laws that smooth
# the friction drift.
model dry_friction

parameter M  = 1    {kg}
parameter F0 = 0.5  {N}         # level of friction, static and kinetic alike

# The load of equation (20).
parameter ramp  = 0.8   {N/s}
parameter top   = 0.52  {N}
parameter mean  = 0.336 {N}
parameter swing = 0.144 {N}
parameter omega = 100   {rad/s}

state p = 0  {m}
state v = 0  {m/s}

let fe = if t < 2 then min(top, ramp*t) else mean + swing*cos(omega*t)  {N}

force F = F0*sgn(v)  {N}        # any value in [-F0, F0] where v = 0

der(p) = v
M*der(v) = fe - F

approximate F: K = 5e3 {N/m}, beta = 2e-3 {s}
simulate 5 {s} step 1e-3 {s} method rk4
