parameter M = 1
state p = 0
der(p) = 0
