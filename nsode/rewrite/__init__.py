"""nsode.rewrite."""
