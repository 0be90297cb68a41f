model decay
state x = 1
dx/dt = -x
