model decay
state x = 1
xdot = -x
