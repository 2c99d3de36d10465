"""A roslens plug-in that finds fixed waits in the code of a robot."""
