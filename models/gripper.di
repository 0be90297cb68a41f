# Two fingers hold an object by friction alone, while the hand shakes.
#
# What the fingers carry is the weight and the shake, up to M*(g + A*omega^2) = 6.3 N; they
# hold as long as mu times both normal forces, 12 N here, exceeds it. A smoothed friction
# law lets the object creep out of the hand; this one does not. Try -p G=6.
model gripper

parameter M  = 0.5   {kg}       # object
parameter m  = 0.2   {kg}       # each finger
parameter d  = 0.06  {m}        # width of the object
parameter G  = 12    {N}        # grip
parameter mu = 0.5
parameter g  = 9.81  {m/s^2}
parameter c  = 20    {N*s/m}    # damping of the fingers
parameter A  = 0.02  {m}        # shake of the hand
parameter omega = 12 {rad/s}

state p[2] = [0, 0]   {m}       # object, level first
state v[2] = [0, 0]   {m/s}
state a = -d/2        {m}       # left finger
state b = d/2         {m}       # right finger
state va = 0          {m/s}
state vb = 0          {m/s}

let lift = A*omega*sin(omega*t)  {m/s}      # the fingers move up and down with the hand

force L = dio(p.x - d/2 - a)  {N}
force R = dio(b - p.x - d/2)  {N}
force FL = mu*L*sgn(v.y - lift)  {N}
force FR = mu*R*sgn(v.y - lift)  {N}

der(p) = v
der(a) = va
der(b) = vb
M*der(v) = [L - R, -M*g - FL - FR]
m*der(va) = G - L - c*va
m*der(vb) = R - G - c*vb

approximate default dio: K = 1e5 {N/m}, beta = 2e-3 {s}, alpha = 1e-3 {s}
approximate default sgn: K = 5e4 {N/m}, beta = 2e-3 {s}
simulate 2 {s} step 1e-4 {s} method rk4
