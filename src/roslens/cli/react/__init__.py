"""``roslens react``: acting by a reference on what runs, or simulating it on a recording.

In come options; out come a watch that acts, and its journal. Begin with ``react_live.py``.
"""
