"""Rules on comments and the bytes of files."""
