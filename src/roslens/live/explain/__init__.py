"""Which fault explains which: first causes, the way to them, and hosts that may be to blame.

In come verdicts and what is known of the system; out come causes with their evidence. Begin with ``explained.py``.
"""
