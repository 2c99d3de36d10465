"""Texts with holes and conditions: partial knowledge of values that source does not determine.

Texts come in and go out. Begin with ``text.py``.
"""
