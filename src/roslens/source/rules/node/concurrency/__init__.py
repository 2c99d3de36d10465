"""Rules on threads, callback groups and what callbacks may still reach."""
