model coupled
state a = 0
state b = 0
der(a)*der(b) = 1
der(b) = sin(der(a))
