"""Computation graphs of a workspace: configurations by what a user names, what the rules find in them, pictures.

In come launch files, arguments or a run; out come configurations, findings and sites. Begin with ``graph_source.py``.
"""
