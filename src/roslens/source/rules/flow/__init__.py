"""What functions do when they are called: which of them are callbacks, what they call, and what is reached from there.

In come parsed files; out come registrations of callbacks and the ways from these to any function. Begin with
``summary.py``, which is the same for all languages; ``python_functions.py`` and its neighbours read Python.
"""
