"""What runs together when a launch file, or all that builds make, is started.

In come a ``Launch`` and the facts of the code that it starts; out comes a ``Configuration``
(``model/configuration.py``) with names resolved and parameters set. Begin with ``assemble.py``.
"""
