"""Values about distributions of ROS."""
