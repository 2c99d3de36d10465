"""Rules on macros and directives."""
