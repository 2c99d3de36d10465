"""Transforms between frames: a buffer with the answers of tf2, and the tree that time lines of transforms come to."""
