"""A reference drafted from what was observed, for a person to edit: each line with its evidence.

In come steps of an observation; out comes YAML. Begin with ``draft.py``.
"""
