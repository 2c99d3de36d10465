"""Evaluates programs symbolically, with bounds.

In come an index of programs and a function or class to begin with; out comes a node that was built (``NodeBuilder``)
with all that was noted of it. Begin with ``interpreter.py``, which owns the state and the parts: ``expressions.py``,
``calls.py``, ``objects.py``, ``functions.py``, and functions for statements, loops and operations. A part reaches the
others by the ``Context`` of the room below. ``vocabulary.py`` finds the overlay that says what a call means.
"""
