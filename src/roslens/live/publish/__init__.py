"""Verdicts and signals reported to other programs: diagnostics, Prometheus, lines of JSON.

In come steps of a session; out come messages and text. Begin with ``turns.py``, which says when what is published.
"""
