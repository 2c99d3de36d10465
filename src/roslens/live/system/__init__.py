"""What is known of a running system: hosts, nodes, processes, topics and connections, and the tree that they form.

In come tallies, samples and graphs; out come entities with their windows and the tree that is shown. Begin with
``world.py``.
"""
