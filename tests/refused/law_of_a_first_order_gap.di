model valve
state x = 1
force N = dio(x)
der(x) = N - 1
approximate N with hunt_crossley: K = 1e3, c = 0.1
