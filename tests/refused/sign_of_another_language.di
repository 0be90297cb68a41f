model m
parameter mu = 0.3
state v = 1
der(v) = -mu*sign(v)
