"""Repositories from elsewhere: what a distribution names, taken into one folder, the same on every machine."""
