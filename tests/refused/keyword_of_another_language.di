model m
var p = 0
der(p) = 0
