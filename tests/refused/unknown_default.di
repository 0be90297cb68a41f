model m
state p = 1
der(p) = -p
approximate default spring: K = 1
