"""Metrics of packages: dependencies between those of a workspace, and findings in one of them.

In come the manifests of a workspace or the findings of a package; out comes one number for each metric. Begin with
``dependency_graph.py``.
"""
