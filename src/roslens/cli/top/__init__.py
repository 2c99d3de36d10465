"""``roslens top``: the robot that runs, in a terminal."""
