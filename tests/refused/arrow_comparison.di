model m
state p = 1
assume p => 0
der(p) = -p
