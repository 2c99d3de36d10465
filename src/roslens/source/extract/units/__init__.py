"""Entry points: what becomes a node when it is started.

In comes an index of programs; out come the facts of the nodes that main functions, classes and modules make. Begin
with ``workspace_units.py``; one unit is evaluated by ``node_units.py``.
"""
