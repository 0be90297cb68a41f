"""nsode.inclusion."""
