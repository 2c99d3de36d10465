"""Parameters that are set: files, their types, and what they make of texts with holes.

In come files and settings; out come values by node and name. Begin with ``parameter_file.py`` for files and
``assemble_parameters.py`` for what is set for one node.
"""
