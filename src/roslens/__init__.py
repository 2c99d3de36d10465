"""roslens: how good is the source of a ROS robot, and does the running robot behave."""

__version__ = "0.2.0"
