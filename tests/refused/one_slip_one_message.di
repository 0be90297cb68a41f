model cascade
parameter stiffness = 1/0
let spring = stiffness*p
let power = spring*v
state p = 0
state v = 1
der(p) = v + drga
der(v) = -spring - power
output work = power
