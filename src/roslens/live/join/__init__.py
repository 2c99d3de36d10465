"""One session over a system: what several observers tell, joined into one graph and handed to the monitor.

In come frames of observers; out comes a step at each tick, with what changed. Begin with ``session.py``.
"""
