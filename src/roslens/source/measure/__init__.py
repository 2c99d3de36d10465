"""One package from bytes to a judged result: parsed once, measured, held against rules, suppressed, gated.

In come a package's files and settings; out come entities, findings and failures. Begin with ``analyse_package.py``,
which workers run; ``finish_package.py`` judges what it returns.
"""
