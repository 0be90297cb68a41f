model m
let R = [[1, 2], [3, 4]]
state p = 1
der(p) = R[1, 2]
