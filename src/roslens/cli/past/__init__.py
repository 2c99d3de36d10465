"""Past revisions of a workspace as runs: made from git's objects, kept, named and shown.

In come revisions; out come stored runs. Begin with ``past_runs.py``.
"""
