model m
parameter M = 1 kg
state p = 1
der(p) = -M*p
