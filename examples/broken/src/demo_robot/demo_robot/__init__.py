"""Three nodes: a laser scanner, odometry and a planner."""
