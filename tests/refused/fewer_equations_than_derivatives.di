model pair
state a = 1
state b = 0
der(a) + der(b) = 1
