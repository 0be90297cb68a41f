model m
state _p = 1
der(_p) = 0
