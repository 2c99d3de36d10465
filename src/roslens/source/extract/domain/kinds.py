"""What a value is, asked in one place: numbers are no truth values, and a text may be known or not."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeGuard, TypeVar

from roslens.source.extract.domain.abstract_value import (
    Handle,
    Named,
    Names,
    NodeBuilder,
    Obj,
    Table,
    Unknown,
    Value,
)
from roslens.source.extract.symbolic.reason import Reason
from roslens.source.extract.symbolic.text import Text

_Kind = TypeVar("_Kind")


def is_number(value: object) -> TypeGuard[int | float]:
    """Return whether a value is a number, which a truth value is not."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is a whole number, which a truth value is not."""
    return isinstance(value, int) and not isinstance(value, bool)


def text_of(value: Value) -> Text | None:
    """Return a text; None of any other value."""
    return value if isinstance(value, Text) else None


def object_of(value: Value) -> Obj | None:
    """Return an object; None of any other value."""
    return value if isinstance(value, Obj) else None


def fields_of(value: Value) -> Names:
    """Return the members of an object; none of any other value."""
    return value.fields if isinstance(value, Obj) else {}


def node_in(value: Value) -> NodeBuilder | None:
    """Return the node that an object is, or that names are resolved against by a handle; None of any other value."""
    return value.node if isinstance(value, Obj | Handle) else None


def table_of(value: Value) -> Table:
    """Return what a table holds; nothing of any other value."""
    return value if isinstance(value, dict) else {}


def reason_of(value: Value, otherwise: Reason) -> Reason:
    """Return why a value is unknown; something else of one that is not."""
    return value.reason if isinstance(value, Unknown) else otherwise


def name_of(value: Value) -> str:
    """Return the whole name of something outside of the workspace; an empty one of any other value."""
    return value.name if isinstance(value, Named) else ""


def known_text(value: Value) -> str | None:
    """Return a text that is known as a whole; None of any other value."""
    return value.known if isinstance(value, Text) else None


def items_of(value: Value) -> list[Value]:
    """Return the items of a list; none of any other value."""
    return value if isinstance(value, list) else []


def all_of_kind(values: Iterable[Value], kind: type[_Kind]) -> list[_Kind]:
    """Return those of some values that are of a kind."""
    return [one for one in values if isinstance(one, kind)]


def first_of_kind(values: Iterable[Value], kind: type[_Kind]) -> _Kind | None:
    """Return the first of some values that is of a kind; None where none is."""
    return next((one for one in values if isinstance(one, kind)), None)


def are_of_kind(values: Iterable[Value], kind: type[_Kind]) -> bool:
    """Return whether all of some values are of a kind."""
    return all(isinstance(one, kind) for one in values)


def has_kind(values: Iterable[Value], kind: type[_Kind]) -> bool:
    """Return whether one of some values is of a kind."""
    return any(isinstance(one, kind) for one in values)
