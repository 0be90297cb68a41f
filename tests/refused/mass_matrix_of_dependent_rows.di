model pair
parameter m = 2
state a = 0
state b = 0
der(a) + 2*der(b) = 1
m*der(a) + 2*m*der(b) = 3
