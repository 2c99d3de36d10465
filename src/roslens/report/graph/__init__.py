"""Computation graphs as text: what runs together, what two of them say differently, and formats of other programs.

In come configurations and their differences; out comes text or a document. Begin with ``graph_text.py``.
"""
