"""How many mistakes that ROS developers reported in public are told by ``roslens check``."""
