"""How a run is written: whole or not at all, by one process at a time.

In come the results of packages, or the rows that other processes made of them; out comes the number of a complete run.
Begin with ``write``.
"""
