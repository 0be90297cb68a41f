# A motor drives a load through an elastic belt; the friction of the load's bearing is
# larger at rest than in motion (Stribeck), so the load sticks and jerks at low speed.
#
# The factor of sgn depends on the speed. That it stays nonnegative follows from
# Ts >= Tc, which is assumed here and checked while the model runs.
model belt_drive

parameter J1 = 2e-3  {kg*m^2}   # motor and its pulley
parameter J2 = 8e-3  {kg*m^2}   # load
parameter k  = 4     {N*m/rad}  # belt
parameter c  = 8e-3  {N*m*s/rad}
parameter Ts = 0.6   {N*m}      # breakaway torque
parameter Tc = 0.3   {N*m}      # sliding torque
parameter ws = 0.5   {rad/s}    # speed at which the one turns into the other
parameter kp = 2     {N*m*s/rad}
parameter ref = 0.8  {rad/s}    # speed asked of the motor

assume Ts >= Tc

state q1 = 0  {rad}
state q2 = 0  {rad}
state w1 = 0  {rad/s}
state w2 = 0  {rad/s}

let belt  = k*(q1 - q2) + c*(w1 - w2)               {N*m}
let level = Tc + (Ts - Tc)*exp(-(w2/ws)^2)          {N*m}

force T = level*sgn(w2)  {N*m}

der(q1) = w1
der(q2) = w2
J1*der(w1) = kp*(ref - w1) - belt
J2*der(w2) = belt - T

approximate T: K = 2000 {N*m/rad}, beta = 2e-3 {s}
simulate 10 {s} step 5e-4 {s} method rk4
