"""What breaks in a workspace between two distributions of ROS; begin with :mod:`.ported`."""
