"""What makes findings in files of a package notes: that it is for Python 2 or an old C++, that a folder is left behind.

In come the hits of all files of a package; out come the same, some of them as notes. Begin with ``older_standard.py``.
"""
