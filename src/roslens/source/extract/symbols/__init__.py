"""What a name means at a place of a workspace.

In come the programs of all files; out come definitions: classes, functions, constants, by linkage and includes. Begin
with ``symbol_table.py``.
"""
