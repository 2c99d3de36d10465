"""Rules on code of nodes: what goes wrong on robots, in C++ and Python."""
