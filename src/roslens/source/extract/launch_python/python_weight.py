"""How large a value of a Python launch file is: few lines make one that no memory holds (``a = [a, a]`` in a loop)."""

from __future__ import annotations

from typing import Any, TypeVar

from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.python_value import Either, Made
from roslens.source.extract.symbolic.text import Text

MOST_WEIGHT = 50_000
"""Values inside each other, counted wherever they stand; no launch file that people write has a tenth."""
_SIGNS = 100
"""So many signs of a text weigh as much as a value."""
_Value = TypeVar("_Value")


class TooLongError(Exception):
    """The bounds of evaluation are spent."""


def bounded(value: _Value, whole: object = None) -> _Value:
    """Return a value.

    Args:
        value: that is kept.
        whole: what it becomes a part of, if it does.

    Raises:
        TooLongError: it is too large to follow, or a part of itself.
    """
    if isinstance(value, bool | int | float) or value is None:
        return value
    waiting: list[Any] = [value]
    weight = 0
    while waiting:
        one = waiting.pop()
        weight += 1 + (len(one) // _SIGNS if isinstance(one, str) else 0)
        if weight > MOST_WEIGHT or (whole is not None and one is whole):
            raise TooLongError
        match one:
            case list() | tuple():
                waiting += one
            case dict():
                waiting += one.values()
            case Text() | Deferred():
                waiting += one.parts
            case Made():
                waiting += (*one.positional, *one.named.values())
            case Either():
                waiting += (one.one, one.other)
    return value
