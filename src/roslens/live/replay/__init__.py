"""Recordings through the session that watches live systems, and the alarms that come of it.

In come a recording and references; out come steps and alarms, which are compared with expected ones. Begin with
``replay.py``.
"""
