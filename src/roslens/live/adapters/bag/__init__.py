"""Recordings: ROS 1 bags, MCAP and SQLite bags of ROS 2, read from their index wherever that is enough.

In comes a file or folder; out come steps with tallies and graphs. Begin with ``open_bag.py``.
"""
