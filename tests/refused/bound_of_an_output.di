model m
state p = 1 {m}
der(p) = -p
output y = p {m} >= 0
