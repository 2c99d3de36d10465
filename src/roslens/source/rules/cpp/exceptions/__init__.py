"""Rules on what is thrown and caught."""
