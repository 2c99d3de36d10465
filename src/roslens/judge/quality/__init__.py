"""Quality models: constraints on metrics of source, the findings that break them, and gates on whole runs.

In come a model's document and the values of entities; out come findings and ratings. Begin with ``quality_model.py``;
``thresholds.py`` applies one.
"""
