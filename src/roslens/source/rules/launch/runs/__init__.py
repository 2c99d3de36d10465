"""Rules on what launch files for ROS 2 come to when they are evaluated."""
