"""Reference documents read into values: constraints, field checks, chains, reactions and time lines.

In comes YAML text; out come the values of ``judge.reference``, or errors with their places. Begin with
``read_reference.py``.
"""
