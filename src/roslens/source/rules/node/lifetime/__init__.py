"""Rules on how a node begins, runs and ends."""
