model brake
parameter level = 2
state v = 1
state heat = 0
let friction = level - heat
der(v) = -friction*sgn(v)
der(heat) = abs(v)
