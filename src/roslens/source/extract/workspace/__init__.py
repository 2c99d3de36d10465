"""The code of a workspace as nodes, through the cache: where the commands begin.

In come packages that were found, settings and a cache; out come facts of nodes, builds, interfaces and launch files,
each part kept under the hash of all that it depends on. Begin with ``extraction.py`` for all of a workspace, or with
``workspace_facts.py``, which evaluates only what is asked for.
"""
