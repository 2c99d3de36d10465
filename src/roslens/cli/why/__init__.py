"""What ``roslens why`` looks at: source, recordings and running systems as evidence.

In come options; out comes what `compare.why` joins to an answer. Begin with ``declared_evidence.py``.
"""
