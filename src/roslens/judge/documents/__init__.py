"""YAML documents with the place of every node, so that an error states where and what was expected.

In comes the text of a document; out come typed values and errors with line and column. Begin with ``document.py``.
"""
