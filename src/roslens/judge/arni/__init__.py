"""References made of specifications of ARNI, and what became of each of their lines.

In comes a file of ARNI; out come a reference as text and notes on what has no counterpart. Begin with
``import_arni.py``.
"""
