"""Where frames of a live system come from: observers as child processes, agents over the network, this host.

In come options and addresses; out come sources of a session, and references that stand in parameters. Begin with
``child_source.py``.
"""
