"""Rules on headers and what is included."""
