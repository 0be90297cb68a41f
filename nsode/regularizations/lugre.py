"""LuGre (12), and Dahl as B = D = 0: bristles that creep under a load below the limit."""
