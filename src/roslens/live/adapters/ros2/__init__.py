"""ROS 2: a process of its own in a Python with rclpy, which tells graph and traffic as frames on standard output."""

TOOL = "ros2"
