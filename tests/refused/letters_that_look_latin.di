model fall
state maсs = 1
parameter μ = 0.3
parameter µ = 0.3
der(maсs) = -μ
