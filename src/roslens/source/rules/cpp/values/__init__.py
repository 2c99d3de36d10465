"""Rules on what values a program of C++ has at a place: moved, erased, compared, checked too late."""
