model m
state p = []
