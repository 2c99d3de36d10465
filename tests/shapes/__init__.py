"""Worst shapes of every grammar: what makes them, what reads them, and what that took (docs/worst_shapes.md)."""
