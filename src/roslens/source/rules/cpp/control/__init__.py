"""Rules on branches, loops and jumps."""
