"""``roslens top``: the robot that runs, in a terminal.

In come snapshots of a monitor; out comes a screen. Begin with ``board.py``.
"""
