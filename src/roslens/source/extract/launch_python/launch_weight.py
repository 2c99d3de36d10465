"""How large a value of a Python launch file is: few lines make one that no memory holds (``a = [a, a]`` in a loop)."""

from __future__ import annotations

from typing import Any, TypeVar

from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.transfer.budget import BudgetExceededError

MOST_WEIGHT = 50_000
"""Values inside each other, counted wherever they stand; no launch file that people write has a tenth."""
_SIGNS = 100
"""So many signs of a text weigh as much as a value."""
_Value = TypeVar("_Value")


class Weight:
    """What was counted of one value so far."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._counted = 0

    def add(self, value: object) -> None:
        """Count a value, but for what is inside of it.

        Raises:
            BudgetExceededError: it is too large to follow.
        """
        self._counted += 1 + (len(value) // _SIGNS if isinstance(value, str) else 0)
        if self._counted > MOST_WEIGHT:
            raise BudgetExceededError


def bounded(value: _Value) -> _Value:
    """Return a value.

    Raises:
        BudgetExceededError: it is too large to follow, or a part of itself.
    """
    waiting: list[Any] = [value]
    weight = Weight()
    while waiting:
        one = waiting.pop()
        weight.add(one)
        match one:
            case list() | tuple():
                waiting += one
            case dict():
                waiting += one.values()
            case Text() | Deferred():
                waiting += one.parts
    return value
