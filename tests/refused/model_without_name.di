model
state p = 0
der(p) = 0
