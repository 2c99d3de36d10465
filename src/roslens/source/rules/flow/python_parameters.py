"""How many arguments a function of Python takes, after those that are bound to it already."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.summary import Target

_SPLATS = {"list_splat_pattern": "*", "keyword_separator": "*", "dictionary_splat_pattern": "**"}


class Parameter(msgspec.Struct, frozen=True):
    """A parameter of a function.

    Attributes:
        name: of it; ``*`` and ``**`` for what takes all further arguments.
        by_name: it is given by name only.
        has_default: it need not be given.
    """

    name: str
    by_name: bool = False
    has_default: bool = False


class Takes(msgspec.Struct, frozen=True):
    """What a function takes.

    Attributes:
        least: arguments by position without a default.
        most: arguments by position; None for any number.
        named: names of parameters without a default that are given by name only.
    """

    least: int
    most: int | None
    named: tuple[str, ...] = ()

    def fits(self, number: int) -> bool:
        """Return whether it can be called with so many arguments by position."""
        return self.least <= number and (self.most is None or number <= self.most) and not self.named


def parameters_of(function: Node, view: FileView) -> Iterator[Parameter]:
    """Yield the parameters of a definition or lambda, in order."""
    listed = function.child_by_field_name("parameters")
    by_name = False
    for one in listed.named_children if listed is not None else ():
        kind, has_default = one.type, one.type in ("default_parameter", "typed_default_parameter")
        if kind == "typed_parameter" and one.named_children:
            kind = one.named_children[0].type
        if kind in _SPLATS:
            if kind != "keyword_separator":
                yield Parameter(_SPLATS[kind])
            by_name = True
        elif kind not in ("comment", "line_continuation", "positional_separator"):
            name = view.text(one.child_by_field_name("name")) or view.text(one).partition(":")[0].strip()
            yield Parameter(name, by_name, has_default)


def takes_of(target: Target, view: FileView) -> Takes:
    """Return what is left to be given to a function that an expression means."""
    parameters = list(parameters_of(target.function, view))
    given = [index for index, one in enumerate(parameters) if one.name in target.keywords]
    # What ``partial`` gives by name, and all after it, can no longer be given by position.
    first = min(given, default=len(parameters))
    placed = [one for one in parameters[:first] if not one.by_name and not one.name.startswith("*")]
    named = [
        one.name
        for index, one in enumerate(parameters)
        if (one.by_name or index > first) and not one.has_default and one.name not in ("*", "**", *target.keywords)
    ]
    least = sum(not one.has_default for one in placed)
    is_open = any(one.name == "*" for one in parameters)
    most = None if is_open else max(len(placed) - target.bound, 0)
    return Takes(max(least - target.bound, 0), most, tuple(named))
