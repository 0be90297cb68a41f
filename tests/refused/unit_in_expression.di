model m
state p = 1 {m}
der(p) = 9.8 {m/s^2}*p
