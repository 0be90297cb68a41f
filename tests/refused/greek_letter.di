model m
parameter μ = 0.1
