"""Hunt and Crossley (1975): damping grows with the depth, so nothing jumps at the touch."""
