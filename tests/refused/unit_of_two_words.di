model torque
parameter T = 1 {N m}
state w = 0
der(w) = T
