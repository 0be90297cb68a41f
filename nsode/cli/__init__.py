"""nsode.cli."""
