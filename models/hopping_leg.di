# A body on a springy leg that hops: the leg pumps with its rest length, the foot leaves
# the ground and lands again, and a stop ends the stroke of the leg.
#
# Both contacts are rigid: the ground under the foot, and the stop inside the leg.
model hopping_leg

parameter M  = 2      {kg}      # body
parameter m  = 0.3    {kg}      # foot
parameter k  = 1200   {N/m}     # spring of the leg
parameter c  = 4      {N*s/m}
parameter l0 = 0.5    {m}       # rest length
parameter s  = 0.56   {m}       # longest the leg gets
parameter A  = 0.04   {m}       # stroke of the pump
parameter omega = 18  {rad/s}
parameter g  = 9.81   {m/s^2}

state y  = 0.7  {m}             # body
state yf = 0.2  {m}             # foot
state v  = 0    {m/s}
state vf = 0    {m/s}

let rest = l0 + A*sin(omega*t)              {m}
let leg  = k*(rest - (y - yf)) - c*(v - vf) {N}

force N = dio(yf)            {N}            # ground on the foot
force S = dio(s - (y - yf))  {N}            # stop: pulls body and foot together

der(y) = v
der(yf) = vf
M*der(v) = leg - S - M*g
m*der(vf) = N + S - leg - m*g

approximate N: K = 2e5 {N/m}, beta = 4e-3 {s}, alpha = 8e-4 {s}
approximate S: K = 2e5 {N/m}, beta = 4e-3 {s}, alpha = 8e-4 {s}
simulate 5 {s} step 2e-4 {s} method rk4
