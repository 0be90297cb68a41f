"""nsode.passes."""
