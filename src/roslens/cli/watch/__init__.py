"""``roslens watch``: which observers are started, and where each step of the session is reported.

In come options; out come lines, served pages and an exit code. Begin with ``watch_live.py``.
"""
