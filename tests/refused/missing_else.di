model m
state p = 1
let f = if p > 0 then 1
der(p) = f
