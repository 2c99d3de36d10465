"""Rules on what the source should not know: secrets, machines, paths."""
