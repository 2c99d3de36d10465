"""Metrics of classes after Chidamber and Kemerer, and their relatives: coupling, cohesion, inheritance, methods.

In comes a class as the whole package shows it; out comes one number for each metric. Begin with ``cbo.py``.
"""
