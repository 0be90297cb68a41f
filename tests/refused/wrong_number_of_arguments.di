model slider
state v = 1
der(v) = -atan2(v)*sgn(v, 0)
