"""A class as the whole package shows it: what the metrics of classes are functions of."""

from __future__ import annotations

import msgspec

from roslens.source.syntax.facts import ClassFacts, FunctionFacts


class ClassInPackage(msgspec.Struct, frozen=True, gc=False):
    """A class with the information on it from other files of its package.

    ``bodies`` are its member functions that have one, wherever in the package they are written.
    ``suppliers`` are the other classes it uses, ``clients`` those of the package that use it: full
    names of classes of the package, names as written of others. ``children`` are the classes of the
    package that derive from it directly. ``depth`` is the length of the longest way up to a class
    without bases; one outside the package counts as such.
    """

    facts: ClassFacts
    bodies: tuple[FunctionFacts, ...] = ()
    suppliers: frozenset[str] = frozenset()
    clients: frozenset[str] = frozenset()
    children: frozenset[str] = frozenset()
    depth: int = 0
