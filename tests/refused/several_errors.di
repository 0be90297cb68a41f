model m
paramter M = 1
state p = 010
let f = (p + 1
force N = dio(p))
der(p) = M*+f
