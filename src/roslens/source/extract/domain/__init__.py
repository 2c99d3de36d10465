"""The values that an evaluation works with, and the state that holds them.

Values come in and go out: texts with holes, objects, qualities of service, lists, what may be one or another. Begin
with ``abstract_value.py``; ``frame.py`` joins what two ways come to, ``state.py`` is where an evaluation stands.
"""
