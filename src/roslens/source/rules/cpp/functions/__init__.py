"""Rules on what functions take, call and return."""
