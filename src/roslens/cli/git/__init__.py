"""A git repository that is read: nothing is checked out, fetched or run.

In come revisions; out come files, names and renames. Begin with ``git_repository.py``.
"""
