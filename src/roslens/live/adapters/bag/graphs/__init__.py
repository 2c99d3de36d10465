"""The computation graph as far as a recording knows it.

In come channels and decoded messages; out comes a graph. Begin with ``recorded_graph.py``.
"""
