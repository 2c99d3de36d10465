"""Distributions of ROS: which there are, which one a workspace is for, and what they deprecated and removed.

``distributions.toml`` lists them, ``changes/*.toml`` what changes between them; :mod:`.read_changes` reads these
tables, and :mod:`.target` tells what a package is to be built for.
"""
