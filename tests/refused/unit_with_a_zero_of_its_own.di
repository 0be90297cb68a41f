model cooling
parameter T0 = 20 {degC}
state T = 350 {K}
der(T) = T0 - T
