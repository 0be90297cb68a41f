model slider
state p = 0
state v = 1
let belt = if p > 1 then 1 else -1
der(p) = v
der(v) = -sgn(v - belt)
