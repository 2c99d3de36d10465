"""Size of functions and files: lines, comments, duplicated lines, and how many parts a file has.

In come counts of lines and the facts of a file; out comes one number for each metric. Begin with ``loc.py``.
"""
