model block
state p = 1
state v = 0
state w = 1
force N = dio(p)
let load = 2*N
force F = 0.3*load*sgn(w)
der(p) = v
der(v) = N - 9.8
der(w) = -F
approximate N with kelvin_voigt: K = 1e5, B = 400
approximate F: K = 1e5, beta = 4e-3
