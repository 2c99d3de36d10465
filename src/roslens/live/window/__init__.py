"""Traffic of the last seconds: buckets of tallies, the windows made of them, and the signals that windows give.

In come tallies with the times of their observers; out come values of signals and what shows them. Begin with
``window.py``; ``signals.py`` is the table of what is measured.
"""
