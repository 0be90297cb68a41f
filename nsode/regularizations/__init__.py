"""nsode.regularizations."""
