model slider
parameter F0 = 1
state v = 1
der(v) = -F0/v*sgn(v)
