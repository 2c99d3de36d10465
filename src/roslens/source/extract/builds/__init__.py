"""Which source ends in which executable or library.

In come ``CMakeLists.txt``, ``setup.py`` and descriptions of plug-ins; out come targets. Begin with ``targets.py``;
``cmake_evaluation.py`` follows the commands of CMake.
"""
