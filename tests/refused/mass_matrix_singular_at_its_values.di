model pair
parameter a = 1
state x = 0
state y = 0
[[a, 2], [2, 4]]*der([x, y]) = [1, 2]
