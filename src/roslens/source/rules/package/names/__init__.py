"""Rules on what a manifest and definitions name."""
