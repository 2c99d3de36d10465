"""Evaluates programs symbolically, with bounds.

In come an index of programs and a function or class to begin with; out comes a node that was built (``Building``)
with all that was noted of it. Begin with ``evaluation.py``; statements, expressions, calls and objects are in
``evaluated_*.py``, and ``vocabulary.py`` finds the overlay that says what a call means.
"""
