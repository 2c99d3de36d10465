"""Syntax trees as programs: one form for C++ and Python, which know nothing of each other.

In comes the tree of the one parse of a file; out comes a ``Program`` (``ir/program.py``).
"""
