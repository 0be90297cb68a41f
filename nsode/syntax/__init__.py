"""nsode.syntax."""
