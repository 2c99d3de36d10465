"""Reads the signatures of launch and launch_ros out of clones, for the tables that rules on launch files judge by."""
