model m
state p = 1 // position
der(p) = -p /* falls */
