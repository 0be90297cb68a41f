model ramp
parameter tau = 2 {s}
state x = 0 {m}
let goal = 5 + x {mm}
der(x) = goal/tau
