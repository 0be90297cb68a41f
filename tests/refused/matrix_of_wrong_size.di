model slider
parameter m = 2
state v[2] = [1, 0]
let mass = [[m, 0, 0], [0, m, 0]]
mass*der(v) = [1, 2]
