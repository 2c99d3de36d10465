"""What is said of nodes, targets and launched processes, and the names and files they are said of.

Nothing is evaluated here: other rooms fill these values. Begin with ``node_facts.py`` and ``launched.py``.
"""
