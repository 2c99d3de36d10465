"""Reference pages and JSON Schemas of documents, generated from the declarations that read them.

In come declarations; out come Markdown and JSON Schema. Begin with ``references_page.py``.
"""
