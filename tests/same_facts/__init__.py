"""Whether two revisions of roslens say the same of many repositories: ``make same-facts BASE=REV``.

In come a revision and clones of the repositories that ``repositories.repos`` names, below ``$ROSLENS_CORPORA``; out
come the differences between what that revision and the working tree say of nodes, builds, interfaces, launch files,
configurations and findings of the graph. Begin with ``__main__.py``.
"""
