model m
let f(x) = x^2
state p = 1
der(p) = f(p)
