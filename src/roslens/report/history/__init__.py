"""What was kept over time as text: series of a live system, trends over revisions, journals of reactions.

In come rows of the store; out come lines, tables or documents. Begin with ``history_text.py``.
"""
