"""Mistakes of real robots, each with its correction: whether `roslens graph --check` tells them."""
