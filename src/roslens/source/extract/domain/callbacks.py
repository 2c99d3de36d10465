"""Callbacks that were given away, and which functions were reached."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Callable, Value
from roslens.source.extract.domain.summaries import Summaries
from roslens.source.extract.symbolic.text import Condition, Text
from roslens.source.extract.symbols.reached_functions import Reached


class Callbacks:
    """What is called later, by what is outside of the workspace.

    Attributes:
        waiting: callbacks that were given away, and what has to be so that they are called.
        reached: functions that were followed.
        running: whether the node runs already: what is evaluated is called back, or comes when it has spun.
    """

    __slots__ = ("_summaries", "reached", "running", "waiting")

    def __init__(self, summaries: Summaries) -> None:
        """Begin with none; ``summaries`` is notified of each."""
        self._summaries = summaries
        self.waiting: list[tuple[Callable, Condition | None]] = []
        self.reached = Reached()
        self.running = False

    def give(self, callback: Value, note: Condition | None = None) -> str:
        """Remember that a callback was given away; return its name."""
        match callback:
            case Callable():
                # What was followed already is not followed later.
                if (callback.path, callback.function.line) not in self.reached:
                    self._summaries.touch()
                    self.waiting.append((callback, note))
                return callback.function.qualified_name
            case Text():
                return str(callback)
        return ""
