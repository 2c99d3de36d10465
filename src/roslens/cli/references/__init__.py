"""The verbs of ``roslens reference``: drafting, testing, mutating and exporting references.

In come references and recordings; out come documents, verdicts and exit codes. Begin with ``reference_test.py``.
"""
