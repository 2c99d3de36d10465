"""One verb per file: ``TEXT`` (one line), ``EXAMPLES``, ``add_arguments`` and ``run``.

In come options of a command line; out comes an exit code. Begin with ``check.py``.
"""
