"""Many packages as text: the tables of a study, and the percentile of a package in the field.

In come statistics; out come text, CSV and LaTeX. Begin with ``study_tables.py``.
"""
