model pendulum
parameter L = 1 {m}
parameter g = 9.8 {m/s^2}
state s = 0.1 {m}
state v = 0 {m/s}
der(s) = v
der(v) = -g*sin(s)
