"""nsode.integrators."""
