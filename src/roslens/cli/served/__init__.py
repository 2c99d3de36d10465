"""What ``roslens serve`` shows besides a run: recordings, histories, findings to be accepted.

In come options and a run; out come parts of a site. Begin with ``recording.py``.
"""
