"""A row of a table of changes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec


class Row(msgspec.Struct, frozen=True):
    """What happened to a name; the fields are those of ``roslens.source.distributions.read_changes.Change``."""

    name: str
    deprecated: str = ""
    removed: str = ""
    instead: str = ""
    since: str = ""
    alike: bool = False
    note: str = ""


def lines_of(rows: Iterable[Row]) -> Iterator[str]:
    """Yield a line of TOML for each row, sorted by name."""
    for row in sorted(rows, key=lambda one: one.name):
        fields = [
            f'{key} = "{value}"'
            for key in ("deprecated", "removed", "instead", "since", "note")
            if (value := getattr(row, key))
        ]
        if row.alike:
            fields.append("alike = true")
        yield f'"{row.name}" = {{ {", ".join(fields)} }}'
