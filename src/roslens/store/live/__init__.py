"""The history of live systems.

Begin with ``history.py``.
"""
