"""Kelvin-Voigt cut off at zero (16): never pulls, jumps at the touch."""
