"""Interfaces of a workspace at two times: the state of each, what changed, and who is affected.

In come a work tree, a revision or a lock file; out comes an `InterfaceDifference` with its users. Begin with
``states.py``.
"""
