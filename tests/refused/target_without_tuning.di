model bouncing
state p = 1
state v = 0
force N = dio(p)
der(p) = v
der(v) = N - 9.8
approximate N: restitution = 0.6, impact_speed = 3 {m/s}, penetration = 1e-3 {m}
