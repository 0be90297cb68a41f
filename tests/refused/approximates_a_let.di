model slider
state v = 1
force Friction = sgn(v)
der(v) = -Friction
approximate friction: K = 1e5, beta = 4e-3
