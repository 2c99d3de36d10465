"""What a watch shows: the live page with its past and its references, and the tree on a terminal.

In come a session and the time; out come documents for the browser and lines for the terminal. Begin with
``watch_page.py``.
"""
