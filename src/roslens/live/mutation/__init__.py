"""Known faults put into a healthy recording: which of them a reference detects, and with how many false alarms.

In come a recording and a reference; out comes a score for each kind of fault. Begin with ``trial.py``.
"""
