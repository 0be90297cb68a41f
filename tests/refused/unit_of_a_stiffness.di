model dry_friction
parameter M = 1 {kg}
parameter F0 = 0.5 {N}
state v = 1 {m/s}
force F = F0*sgn(v)
M*der(v) = -F
approximate F: K = 5e3 {N}, beta = 2e-3 {s}
