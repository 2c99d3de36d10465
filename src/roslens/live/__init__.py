"""The live half: what a running ROS system, or a recording of one, does."""
