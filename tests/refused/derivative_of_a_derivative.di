model falling
state p = 1
der(der(p)) = -9.8
