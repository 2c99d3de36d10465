"""ROS 2: a process of its own in a Python with rclpy.

In come the graph and the topics of rclpy; out come frames on standard output. Begin with ``observation.py``.
"""

TOOL = "ros2"
