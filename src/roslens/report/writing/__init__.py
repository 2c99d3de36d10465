"""What formats share: the width and colours of a terminal, numbers, CSV, Parquet, and files that are written whole.

In come cells and lines; out come characters and files. Begin with ``terminal.py``.
"""
