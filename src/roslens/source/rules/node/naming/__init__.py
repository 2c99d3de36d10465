"""Rules on names of nodes, topics, services and parameters that ROS refuses."""
