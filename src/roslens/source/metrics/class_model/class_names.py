"""Which class of a package a name means, at the place where it is written."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable


class ClassNames:
    """The classes of one package and one language, found by name from the scope outwards.

    ``separator`` is ``::`` or ``.``; full names are unique and hold it between their parts.
    """

    def __init__(self, full_names: Iterable[str], separator: str) -> None:
        """Index ``full_names`` by their last part."""
        self._separator = separator
        self._all = frozenset(full_names)
        self._by_last_part: defaultdict[str, list[str]] = defaultdict(list)
        for name in sorted(self._all):
            self._by_last_part[name.rpartition(separator)[2]].append(name)
        self._answers: dict[tuple[str, str], str | None] = {}

    def find(self, name: str, scope: str) -> str | None:
        """Return the full name of the class that ``name`` means inside ``scope``, None if it has none here.

        The innermost scope that has the name wins, as in the language. A name that no enclosing scope
        has is taken for the only class of the package that ends with it (it came in through ``using``
        or ``import``); where several do, it stays unknown.
        """
        key = (name, scope)
        if key not in self._answers:
            self._answers[key] = self._find(name, scope)
        return self._answers[key]

    def candidates(self, name: str) -> tuple[str, ...]:
        """Return the full names of the classes that have the last part of ``name``, sorted."""
        return tuple(self._by_last_part.get(name.rpartition(self._separator)[2], ()))

    def _find(self, name: str, scope: str) -> str | None:
        last_part = name.rpartition(self._separator)[2]
        candidates = self._by_last_part.get(last_part)
        if not candidates:
            return None
        while scope:
            full_name = f"{scope}{self._separator}{name}"
            if full_name in self._all:
                return full_name
            scope = scope.rpartition(self._separator)[0]
        if name in self._all:
            return name
        ending = self._separator + name
        matching = [candidate for candidate in candidates if candidate.endswith(ending)]
        return matching[0] if len(matching) == 1 else None
