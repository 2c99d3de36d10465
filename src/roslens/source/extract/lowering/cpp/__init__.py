"""Syntax trees of C++ as programs.

In comes a tree of tree-sitter; out comes a ``Program`` (``ir/program.py``). Begin with ``cpp_program.py``.
"""
