"""Patterns on the names of entities, matched in time linear in the length of a name.

In comes a pattern as text; out comes a matcher, or an error that says what is wrong with it. Begin with
``pattern.py``.
"""
