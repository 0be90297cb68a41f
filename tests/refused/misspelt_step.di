model decay
state x = 1
der(x) = -x
simulate 1 stp 1e-3
