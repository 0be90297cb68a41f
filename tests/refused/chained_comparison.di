model m
state p = 1
let f = (if 0 < p < 1 then 1 else 2)
der(p) = f
