model pair
state a = 1
state b = 0
der(a) + a*der(b) = 1
der(a) + a*der(b) = 2
