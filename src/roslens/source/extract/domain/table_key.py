"""Values as keys of tables: texts and numbers by what they are, objects by which they are."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Callable, Class, Handle, Key, Made, Obj, Value
from roslens.source.extract.symbolic.text import Text

_PLAIN = (Text, str, int, float, bool, type(None))
_MOST_ITEMS = 50


class ObjectKey(str):
    """Stands for an object of which nothing is compared but which one it is; as a text it names its kind.

    What an object holds is no part of it: that changes, and to write it down takes longer the more objects know of each
    other.
    """

    held: tuple[object, ...]

    def __new__(cls, kind: str, *held: object) -> ObjectKey:
        """Return the key of what is held: an object, or a function and the object that it is bound to."""
        made = super().__new__(cls, kind)
        made.held = held
        return made

    def __eq__(self, other: object) -> bool:
        """Whether the same is held."""
        if not isinstance(other, ObjectKey) or len(self.held) != len(other.held):
            return False
        return all(one is two for one, two in zip(self.held, other.held, strict=True))

    def __ne__(self, other: object) -> bool:
        """Whether something else is held."""
        return not self == other

    def __hash__(self) -> int:
        """Return a hash of which is held."""
        return hash(tuple(map(id, self.held)))


def hashable(value: Value) -> Key:
    """Return a value as a key of a dictionary."""
    match value:
        case Text() | str() | int() | float() | None:
            return value
        case Obj():
            return ObjectKey(f"a {value.type}", value)
        case Callable():
            return ObjectKey(f"{value.function.name}()", value.function, value.self)
        case Class():
            return ObjectKey(value.defined.what.qualified_name, value.defined.what)
        case list() if len(value) <= _MOST_ITEMS and all(isinstance(one, _PLAIN) for one in value):
            return str(value)
        case list() | dict() | Handle() | Made():
            return ObjectKey(type(value).__name__, value)
    return str(value)
