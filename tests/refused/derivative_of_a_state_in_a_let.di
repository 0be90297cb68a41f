model tracking
parameter eta = 3
state p = 1
state v = 0
let r = sin(t)
let error = der(p) - der(r)
der(p) = v
der(v) = der(der(r)) - eta*sgn(error)
