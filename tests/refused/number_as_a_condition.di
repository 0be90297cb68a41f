model slider
state v = 1
der(v) = if v then -1 else 0
