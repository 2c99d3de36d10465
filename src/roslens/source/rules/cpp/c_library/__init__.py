"""Rules on functions of the C library."""
