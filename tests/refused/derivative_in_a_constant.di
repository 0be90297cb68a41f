model slider
state v = 1
let r = 4*t
der(v) = -sgn(v)
approximate default sgn: K = der(r), beta = 4e-3
