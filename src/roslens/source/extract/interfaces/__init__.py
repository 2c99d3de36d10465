"""Messages, services and actions.

In come ``.msg``, ``.srv`` and ``.action`` files; out come their fields and checksums (MD5, RIHS01). Begin with
``interface_file.py``.
"""
