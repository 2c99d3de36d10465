"""Classes as the whole package shows them: declared in one file, defined in others, derived in a third.

In come the facts of all files of a package; out come its classes with members, uses and ancestors. Begin with
``join_classes.py``; ``class_in_package.py`` is what it returns.
"""
