"""What single constructs do to the state of an evaluation: closures, references, lists, static storage, attributes.

In come a construct and the evaluation as a ``Context``; out come values, and a state that is changed. Begin with
``context.py``: it is what these functions and the overlays see of the interpreter.
"""
