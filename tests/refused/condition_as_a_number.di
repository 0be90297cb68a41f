model slider
state v = 1
let moving = v > 0
der(v) = -moving*sgn(v)
