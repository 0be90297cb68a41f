# A pendulum on a cart, with dry friction in the rail and in the joint.
#
# The two accelerations are coupled by a mass matrix that depends on the angle. The
# equations stand as Lagrange's method gives them; nsode solves them for the rates.
model cart_pole

parameter mc = 1     {kg}       # cart
parameter mp = 0.2   {kg}       # pendulum
parameter l  = 0.4   {m}
parameter g  = 9.81  {m/s^2}
parameter Fc = 0.4   {N}        # friction of the rail
parameter T0 = 4e-3  {N*m}      # friction of the joint

input fe = 0 {N}                # pushes the cart

state x   = 0         {m}
state phi = 170 {deg}           # from hanging down
state v   = 0         {m/s}
state w   = 0         {rad/s}

force F = Fc*sgn(v)  {N}
force T = T0*sgn(w)  {N*m}

der(x) = v
der(phi) = w
(mc + mp)*der(v) + mp*l*cos(phi)*der(w) = fe + mp*l*w^2*sin(phi) - F
mp*l*cos(phi)*der(v) + mp*l^2*der(w) = -mp*g*l*sin(phi) - T

output tip[2] = [x + l*sin(phi), -l*cos(phi)]  {m}

approximate F: K = 2e4 {N/m}, beta = 5e-3 {s}
approximate T: K = 50 {N*m/rad}, beta = 2e-2 {s}
simulate 20 {s} step 5e-4 {s} method rk4
