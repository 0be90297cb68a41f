model driven
input position = 0
state p = 0
der(p) = der(position)
