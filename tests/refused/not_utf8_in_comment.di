model m # café
state p = 1
der(p) = -p
