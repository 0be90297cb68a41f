# A mass on a moving belt, held by a nonlinear spring (paper, Example III, Section 5.3,
# equations (48) and (49); the system is that of Awrejcewicz, Feckan and Olejnik).
#
# The friction falls with the sliding speed, which feeds the oscillation. At u = 1 the
# mass crosses w = 0 without sticking; try -p u=0.1 to see it stick. With this large a
# beta, RK4 takes steps of 5.5e-5 s while it sticks, and of 1 ms, the paper's, only
# where it does not.
model belt_oscillator

parameter M  = 1    {kg}
parameter k1 = 1    {N/m}
parameter k2 = 1    {N/m^3}
parameter F  = 0.2  {N*m/s}
parameter V  = 1    {m/s}
parameter u  = 1    {m/s}       # speed of the belt

state p = 1.19149  {m}
state w = 0        {m/s}        # velocity of the belt relative to the mass

force Fc = F/(V + abs(w))*sgn(w)  {N}

der(p) = u - w
M*der(w) = k2*p^3 - k1*p - Fc

approximate Fc: K = 1e5 {N/m}, beta = 0.5 {s}
simulate 50 {s} step 5e-5 {s} method rk4
