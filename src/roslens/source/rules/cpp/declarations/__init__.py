"""Rules on variables and types."""
