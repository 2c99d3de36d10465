"""Tables of pages: what is in them, and how they are written.

Begin with ``table.py``.
"""
