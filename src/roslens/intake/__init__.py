"""Bytes and texts that come from outside, taken in within bounds: sizes, depths, what they stand for."""
