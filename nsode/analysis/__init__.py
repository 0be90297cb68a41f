"""What can be known before a run: effective mass, stable steps, energy, restitution."""
