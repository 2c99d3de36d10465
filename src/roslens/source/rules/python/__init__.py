"""Rules on Python that any program should follow."""
