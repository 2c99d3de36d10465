"""Which nodes of a tree are looked at: one compiled query for each syntax, and what others ask for besides.

In comes a tree; out come nodes and extents by what they are for. Begin with ``cpp_query.py``.
"""
