model slider
state p = 0
state v = 1
let mu = if p > 1 then 0.5 else 0.1
der(p) = v
der(v) = -9.8*mu*sgn(v)
