"""Rules on C and C++ that any program should follow, and those of published standards."""
