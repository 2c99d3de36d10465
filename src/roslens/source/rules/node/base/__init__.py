"""Rules about what a class takes over from the node that it is derived from."""
