"""Rules on what the distribution of ROS that a package is built for deprecated or does not have any more."""
