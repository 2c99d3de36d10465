"""Syntax trees of Python as programs.

In comes a tree of tree-sitter; out comes a ``Program`` (``ir/program.py``). Begin with ``python_program.py``.
"""
