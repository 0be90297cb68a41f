model slider
state v = 1
der(v) = -sat(0.5, v)
