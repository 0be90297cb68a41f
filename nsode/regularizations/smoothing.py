"""Smoothing (50): sgn(w) becomes sat(eps, w)/eps; no state, never sticks."""
