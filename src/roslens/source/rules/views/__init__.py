"""What rules on packages look at, made when a rule first asks for it: CMake, launch files, uses, registered classes.

In come the files of a package; out come values with the places of what they hold. Begin with ``package_files.py``.
"""
