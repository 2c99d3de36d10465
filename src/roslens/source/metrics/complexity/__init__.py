"""Complexity of functions: decisions, paths, nesting, and what a function calls, takes and returns.

In come the facts of one function and what the user chose to count; out comes one number for each metric. Begin with
``cyclomatic_complexity.py``; ``countable.py`` decides which parts of a function count.
"""
