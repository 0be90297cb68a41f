model tracking
parameter eta = 3
state v = 0
let r = sin(t)
let error = v - der(r)
der(v) = der(r) - eta*sgn(error)
