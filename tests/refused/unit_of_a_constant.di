model m
constant n = 3 {m}
state p = 1
der(p) = -n*p
