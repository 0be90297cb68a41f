model torque
parameter T = 1 {Nm}
parameter J = 1 {kgm2}
state w = 0 {rads}
J*der(w) = T
