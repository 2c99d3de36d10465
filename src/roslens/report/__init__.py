"""From a run, a graph or a history to text: one format per file.

Values of the model and of the store come in; text goes out. Rooms that do not know each other, but for ``writing``:

============= ==========================================================================
room          what it writes
============= ==========================================================================
``run``       the result of a check, and what became of it since another run
``graph``     computation graphs, their differences and comparisons
``history``   what was kept of a live system or of past revisions, and journals
``study``     many packages: statistics, and where one stands among them
``why``       answers of ``roslens why``
``writing``   what all of them share: terminals, numbers, CSV, files written whole
============= ==========================================================================
"""
