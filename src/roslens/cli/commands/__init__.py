"""One verb per file: ``TEXT`` (one line), ``EXAMPLES``, ``add_arguments`` and ``run``."""
