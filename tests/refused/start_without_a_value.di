model fall
parameter E = -1
state v = sqrt(2*E)
der(v) = -v
