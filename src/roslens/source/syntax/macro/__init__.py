"""Macros that a C++ grammar cannot read: found by where they stand or by name, and blanked so that positions hold.

In comes the text of a file; out comes text of the same length that can be parsed. Begin with ``macros.py``.
"""
