"""Recordings: ROS 1 bags, MCAP and SQLite bags of ROS 2, read from their index wherever that is enough."""
