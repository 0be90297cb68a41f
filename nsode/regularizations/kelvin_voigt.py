"""Kelvin-Voigt (15): a spring and a damper while in contact; may pull at the end."""
