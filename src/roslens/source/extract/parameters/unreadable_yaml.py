"""Text that is no YAML, as whoever wrote it is told: the place, and a common slip where it is behind it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.source.extract.facts.refusal import Refusal

if TYPE_CHECKING:
    from yaml import Event, MarkedYAMLError

MOST_DEPTH = 1_000
"""Levels; libyaml takes time that grows with the square of the levels of a text."""


class TooDeepError(ValueError):
    """A text of more than :data:`MOST_DEPTH` levels; ``line`` is where they are reached."""

    def __init__(self, line: int) -> None:
        super().__init__(f"more than {MOST_DEPTH:,} levels")
        self.line = line


def events(content: bytes) -> Iterator[Event]:
    """Yield the events of a YAML text.

    Raises:
        yaml.YAMLError: it is no YAML.
        TooDeepError: it is nested too deeply to be followed.
    """
    import yaml

    depth = 0
    for event in yaml.parse(content, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
        match event:
            case yaml.SequenceStartEvent() | yaml.MappingStartEvent():
                depth += 1
            case yaml.SequenceEndEvent() | yaml.MappingEndEvent():
                depth -= 1
        if depth > MOST_DEPTH:
            raise TooDeepError(place_of(event)[0])
        yield event


def place_of(event: Event) -> tuple[int, int]:
    """Return the line and column at which an event begins, 1-based, the column in characters."""
    mark = event.start_mark
    return (mark.line + 1, mark.column + 1) if mark is not None else (1, 1)


def unreadable(error: MarkedYAMLError, content: bytes) -> Refusal:
    """Return why PyYAML, or libyaml behind it, does not take a text.

    Args:
        error: a ``yaml.MarkedYAMLError``.
        content: of the file.
    """
    mark = error.problem_mark or error.context_mark
    row, column = (mark.line, mark.column) if mark is not None else (0, 0)
    lines = content.decode("utf-8", "replace").splitlines()
    line = lines[row] if row < len(lines) else ""
    if "\t" in line[: len(line) - len(line.lstrip())]:
        return Refusal(row + 1, line.index("\t") + 1, "a tab in the indentation", "spaces, as YAML has no tabs")
    reason = " ".join(one for one in (error.problem, error.context) if one)
    quoted = f" at {line.strip()[:60]!r}" if line.strip() else ""
    return Refusal(row + 1, column + 1, f"no YAML{quoted}: {reason}", "`key: value` lines and `- ` lists")


def other_encoding(error: UnicodeDecodeError) -> Refusal:
    """Return the place at which a text is not in UTF-8."""
    before = error.object[: error.start]
    what = f"the byte 0x{error.object[error.start]:02x}, which is not UTF-8"
    return Refusal(before.count(b"\n") + 1, error.start - before.rfind(b"\n"), what, "text in UTF-8")
