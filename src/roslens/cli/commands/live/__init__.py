"""Verbs about running systems.

In come options of a command line; out comes an exit code. Begin with ``watch.py``.
"""
