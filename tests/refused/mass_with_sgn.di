model pair
state a = 1
state b = 0
(2 + sgn(a))*der(a) + der(b) = 1
der(a) + 2*der(b) = 2
