"""The result of a check as text: for people, for forges and for other programs.

In comes a run of the store; out comes text in one format. Begin with ``formats.py``, which names them all;
``reported.py`` says which findings count.
"""
