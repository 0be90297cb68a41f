model slider
state v = 1
force F = sgn(v)
der(v) = -F
approximate F with kelvin_voigt: K = 1e5, B = 400
