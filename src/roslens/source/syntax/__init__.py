"""One parse of a file: C++ and Python as facts that metrics, rules and extraction share.

In comes the content of a file; out come facts of its functions, classes and lines, and the places that do not parse.
Begin with ``facts.py``; ``cpp.py`` and ``python.py`` make them. ``macro`` blanks what the grammar of C++ cannot read.
"""
