"""A system as it was: what is kept of a session, and the same tree from what was kept.

In come steps of a session or an instant; out come rows of the history or the tree of that instant. Begin with
``keeper.py``.
"""
