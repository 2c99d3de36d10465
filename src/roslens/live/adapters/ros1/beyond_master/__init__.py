"""What nodes know and the master does not: who runs on after its restart, who is not connected, and own types.

In come registrations and what nodes report of their connections; out come registrations, graphs and failures that hold
these too. Begin with ``apart.py``.
"""
