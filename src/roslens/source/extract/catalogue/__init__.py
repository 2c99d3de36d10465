"""Nodes that are known without their source, hints of users, and what every node has.

In come names of packages and executables, and parameters; out come facts of nodes. Begin with ``catalogue.py``; the
data are the YAML files beside it.
"""
