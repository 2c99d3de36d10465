"""Rules on operators, casts and literals."""
