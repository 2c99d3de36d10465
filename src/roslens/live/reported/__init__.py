"""What observers of both generations of ROS share: what nodes and other monitors report of themselves.

In come serialised messages and values of parameters; out come events of bearable length. Begin with
``reported_levels.py``.
"""
