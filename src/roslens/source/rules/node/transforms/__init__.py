"""Rules on transforms and rotations."""
