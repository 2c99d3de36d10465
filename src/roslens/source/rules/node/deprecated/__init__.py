"""Rules on names that a distribution of ROS has deprecated or removed."""
