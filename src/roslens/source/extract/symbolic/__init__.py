"""Texts with holes and conditions: what is known of a value that source does not say.

Texts come in and go out. Begin with ``text.py``.
"""
