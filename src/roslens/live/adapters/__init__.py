"""Where graph and traffic come from, one folder per source. None imports another.

In come protocols of ROS or files of recordings; out come frames of ``model/wire.py``. Begin with ``child.py``, which
keeps the process of an observer running.
"""
