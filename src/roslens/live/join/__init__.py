"""One session over a system: the reports of several observers, joined into one graph for the monitor.

In come frames of observers; out comes a step at each tick, with what changed. Begin with ``session.py``.
"""
