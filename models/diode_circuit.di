# A half-wave rectifier: an ideal diode, a choke and a smoothed load.
#
# The ideal diode is where dio has its name from: no current flows backward (i >= 0),
# and while none flows the diode takes up any voltage that keeps it so. The current
# plays the gap; as it is a state of first order, its K is a resistance.
model diode_circuit

parameter L = 0.05    {H}
parameter C = 2e-3    {F}
parameter Rs = 0.5    {ohm}     # of the choke
parameter R = 40      {ohm}     # load
parameter U = 20      {V}
parameter omega = 314.159265  {rad/s}

state i  = 0  {A}
state vc = 0  {V}

let source = U*sin(omega*t)  {V}

force D = dio(i)  {V}           # voltage that the blocking diode takes up

der(vc) = (i - vc/R)/C
L*der(i) = source - vc - Rs*i + D

output load = vc/R  {A}

approximate D: K = 2000 {ohm}, beta = 2e-4 {s}, alpha = 1e-4 {s}
simulate 0.3 {s} step 1e-5 {s} method rk4
