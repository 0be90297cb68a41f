model slope
parameter F = 0.3
parameter k = 1
state x = 0
state v = 1
der(x) = v
der(v) = -F*sgn(v)*cos(x) - k*x
