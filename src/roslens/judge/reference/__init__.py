"""What references expect of a live system, as values: merged, checked for contradictions, looked up by entity.

In come the values that documents were read into; out come merged references, and what is wrong with them. Begin with
``expectation.py``; ``merge_references.py`` joins several documents.
"""
