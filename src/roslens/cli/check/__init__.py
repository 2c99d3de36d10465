"""What ``roslens check`` does: analyse, compare with a baseline, fix, write, decide.

In come a configuration and options; out come a run, its reports and whether it passes. Begin with ``analysed.py``.
"""
