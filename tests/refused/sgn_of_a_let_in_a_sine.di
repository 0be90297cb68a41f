model slider
state v = 1
let F = 2*sgn(v)
let G = F + v
der(v) = -sin(G)
