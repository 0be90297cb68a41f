model big
parameter M = 1_000
state v = 1
der(v) = -v/M
