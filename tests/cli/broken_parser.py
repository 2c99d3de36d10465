"""A ``sitecustomize`` with which a parser ends its process at the files that ``$BROKEN_BY`` names."""

BREAKING = """
import os
import roslens.intake.file_budget as budget

real = budget._bounded

def bounded(subject, size, seconds):
    # As a parser that is broken, wherever the file is read.
    if subject in os.environ["BROKEN_BY"].split(":"):
        budget._slot[0].put(subject) if budget._slot else None
        os.abort()
    return real(subject, size, seconds)

budget._bounded = bounded
"""
