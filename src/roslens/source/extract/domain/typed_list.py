"""Lists whose type is said beside their items: ``std::vector<std::string>{}``."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.source.extract.domain.abstract_value import Value


class TypedList(list[Value]):
    """A list of C++ that is a value, no initial values in braces.

    Attributes:
        type: of a parameter that it is the value of, ``string_array`` …; empty where only its items tell.
    """

    def __init__(self, items: Iterable[Value] = (), type_: str = "") -> None:
        """Keep items in order."""
        super().__init__(items)
        self.type = type_
