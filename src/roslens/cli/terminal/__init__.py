"""Standard streams, progress, interrupts, and how every end of a command becomes an exit code.

In come results and exceptions; out come text and exit codes. Begin with ``boundary.py``.
"""
