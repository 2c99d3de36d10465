"""Rules on what a node logs."""
