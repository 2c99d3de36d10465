"""``roslens lsp``: findings and fixes as an editor shows them.

In come documents of an editor; out come diagnostics, actions and edits. Begin with ``language_server.py``.
"""
