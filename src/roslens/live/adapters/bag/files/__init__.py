"""Which files a recording is made of, and what is in those that were packed as a whole.

In come paths; out come files that can be read, in order. Begin with ``recorded_files.py``.
"""
