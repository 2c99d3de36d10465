"""Why something does not arrive: one ordered answer from source, a recording or a running system, or of several.

What each of them says of an entity goes in; steps come out. Begin with ``answered.py``.
"""
