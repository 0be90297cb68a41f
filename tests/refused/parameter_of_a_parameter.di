model pendulum
parameter length = 2
parameter period = 2*pi*sqrt(length/9.8)
state phi = 0
der(phi) = 2*pi/period
