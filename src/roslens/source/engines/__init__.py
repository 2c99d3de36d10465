"""Where independent tasks run: in this process, in a pool of processes, or on a cluster of Dask.

In comes a function with tasks that can be pickled; out comes each task with its result, or with what ended it. Begin
with ``executor``.
"""
