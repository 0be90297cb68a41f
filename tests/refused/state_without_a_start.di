model fall
state v
der(v) = -9.8
