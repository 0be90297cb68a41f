model decay
state x = 1  # ‮ not what it looks like
der(x) = -x
