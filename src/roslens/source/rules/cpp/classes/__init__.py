"""Rules on what classes declare."""
