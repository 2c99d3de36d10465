"""What a workspace and its user decide: ``roslens.toml``, where results are kept, which plug-ins are trusted.

In come paths, files and options; out come configurations and open stores. Begin with ``configuration.py``;
``workplace.py`` knows the folder ``.roslens``.
"""
