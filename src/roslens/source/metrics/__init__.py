"""Metrics: pure functions from facts of syntax to values of functions, files, classes and packages.

Facts of a file come in; entities with values go out. ``table.py`` names every metric and says what one consists of;
``measure_file.py``, ``measure_package.py`` and ``measure_workspace.py`` apply them. Begin with ``table.py``.

==================== ===========================================================
room                 what it measures
==================== ===========================================================
``object_oriented``  classes: size, coupling, cohesion, inheritance
``class_model``      what classes are, put together from all files of a package
``complexity``       functions: decisions, paths, nesting, calls
``halstead``         operators and operands, and the maintainability index
``packages``         dependencies between packages, and findings in them
``size``             lines, comments, duplication, number of parts
==================== ===========================================================
"""
