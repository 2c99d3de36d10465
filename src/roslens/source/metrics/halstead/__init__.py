"""Halstead's measures of operators and operands, and the maintainability index, which is calculated from his volume.

In come counts of operators and operands, or values of other metrics; out comes one number for each metric. Begin with
``halstead_volume.py``.
"""
