"""What the tree of the source shows: how long files are, what they are called, and who imports whom."""
