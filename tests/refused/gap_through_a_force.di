model stack
state p = 1
state v = 0
force lower = dio(p)
let gap = p - 1e-3*lower
force upper = dio(gap - 1)
der(p) = v
der(v) = lower - upper - 9.8
