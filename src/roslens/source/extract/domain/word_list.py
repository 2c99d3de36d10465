"""The words of a command line while source is evaluated: a list that may go on with words for ROS."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.source.extract.domain.abstract_value import Foreign, Value
from roslens.source.extract.domain.guarded import is_counted
from roslens.source.extract.domain.kinds import is_whole, known_text
from roslens.source.extract.symbolic.text import Text

ROS_ARGS = "--ros-args"
_END = "--"


class Words(list[Value]):
    """The words of a command line, that of the program first: a list of which nothing is missing.

    Attributes:
        goes_on: whether there are more words after these, all of them for ROS.
    """

    def __init__(self, words: Iterable[Value] = (), *, goes_on: bool = False) -> None:
        """Keep words in order."""
        super().__init__(words)
        self.goes_on = goes_on

    def part(self, first: int | None, last: int | None) -> Words | None:
        """Return the words from a place to before another one; None where these are not known."""
        if not self.goes_on:
            return Words(self[first:last])
        if (first or 0) < 0 or (first or 0) > len(self) or (last is not None and not 0 <= last <= len(self)):
            return None
        return Words(self[first:last], goes_on=last is None)

    def has(self, place: int) -> bool:
        """Return whether the word at a place is known."""
        return (0 if self.goes_on else -len(self)) <= place < len(self)

    @property
    def length(self) -> int | AtLeast:
        """How many words there are."""
        return AtLeast(len(self)) if self.goes_on else len(self)


def length_of(items: list[Value]) -> int | AtLeast:
    """Return how many items a list has, which may go on where it is one of words."""
    return items.length if isinstance(items, Words) else len(items)


def has_place(items: list[Value], place: int) -> bool:
    """Return whether it is known what stands at a place of a list, which is one of its places."""
    return items.has(place) if isinstance(items, Words) else is_counted(items)


class AtLeast(Foreign, frozen=True):
    """A number of which only the least is known."""

    number: int

    def compared(self, operator: str, other: Value) -> bool | None:
        """Return what comparing it with a number says; None where that depends."""
        if not is_whole(other):
            return None
        if operator in (">", ">="):
            return True if self.number > other - (operator == ">=") else None
        if operator in ("<", "<="):
            return False if self.number >= other + (operator == "<=") else None
        return operator == "!=" if operator in ("==", "!=") and self.number > other else None


def words_given(words: Sequence[Text]) -> Words:
    """Return the words that a program is started with; after what launch_ros begins for ROS there may be more."""
    return Words(words, goes_on=bool(words) and words[-1].known == ROS_ARGS)


def without_ros2(words: Sequence[Value]) -> Words:
    """Return words without those for ROS 2: from ``--ros-args`` to ``--``, or to the end (rcl, arguments.c)."""
    kept, of_ros = Words(), False
    for word in words:
        known = known_text(word)
        if known == ROS_ARGS:
            of_ros = True
        elif not of_ros:
            kept.append(word)
        elif known == _END:
            of_ros = False
    return kept
