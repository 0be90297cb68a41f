model brake
parameter static = 1
parameter kinetic = 2
assume static >= kinetic
state v = 1
der(v) = -(static - kinetic)*sgn(v)
