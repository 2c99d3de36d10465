"""Names as other programs send them: of any type, length and script until they were looked at."""

from __future__ import annotations

import re
from typing import Any

from roslens.model.failure import Failure

TOOL = "ros1"
LONGEST_NAME = 1024
MOST_ENTRIES = 100_000
_OBSERVER = re.compile(r"/roslens_[A-Za-z0-9_]+_[0-9]+")


def observer_name(host: str, pid: int) -> str:
    """Return what the observer in process ``pid`` calls itself at the master.

    >>> observer_name("base-1", 7)
    '/roslens_base_1_7'
    """
    return f"/roslens_{re.sub('[^A-Za-z0-9_]', '_', host)}_{pid}"


def is_observer(name: str) -> bool:
    """Whether a name is that of an observer, which is no part of what is observed, whoever's it is."""
    return _OBSERVER.fullmatch(name) is not None


def sound_name(value: Any) -> bool:
    """Whether a value can be shown as a name: printable text of a bearable length."""
    return isinstance(value, str) and 0 < len(value) <= LONGEST_NAME and value.isprintable()


def brief(value: Any) -> str:
    """Return a value as a message quotes it."""
    text = repr(value[:200] if isinstance(value, (str, bytes, list)) else value)
    return text if len(text) <= 80 else text[:77] + "..."


def odd(what: str, source: str, expected: str) -> Failure:
    """Return the failure for a part of an answer that was left out."""
    return Failure(
        TOOL, what, expected, "The rest is shown; find the program that registers or answers this", entity=source,
        partial=True,
    )  # fmt: skip


class Oddities:
    """Collects what was left out of an answer, at most a few of each sort in words and the rest as a number."""

    def __init__(self, source: str, most: int = 3) -> None:
        self._source = source
        self._most = most
        self._counts: dict[str, int] = {}
        self._quoted: list[Failure] = []

    def add(self, sort: str, value: Any, expected: str) -> None:
        """Note one value that is not as expected."""
        self._counts[sort] = self._counts.get(sort, 0) + 1
        if self._counts[sort] <= self._most:
            length = f" ({len(value):,} long)" if isinstance(value, (str, list)) and len(value) > self._most else ""
            self._quoted.append(odd(f"{sort} {brief(value)}{length}", self._source, expected))

    def failures(self) -> tuple[Failure, ...]:
        """Return what is to be reported."""
        more = [
            odd(f"{count - self._most:,} more of: {sort}", self._source, "none")
            for sort, count in self._counts.items()
            if count > self._most
        ]
        return (*self._quoted, *more)
