"""The journal: an append-only file in which each entry is bound to those before it.

Begin with ``journal.py``.
"""
