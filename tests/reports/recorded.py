"""Tables of scores that are kept: ``results/ROUND/*.json``, one for each revision that was scored."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from reports.report_case import ROUNDS
from reports.scoring import Score

RESULTS = Path(__file__).parent / "results"
LATEST = "latest"
"""Name of the table that `make reports` writes anew; the others are kept as they are."""


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The scores of a round at a revision.

    Attributes:
        revision: that was checked out, with changes on top of it where it is the latest table.
        date: of the revision, ISO 8601.
        scores: by name of the case.
    """

    revision: str
    date: str
    scores: list[Score]

    def by_name(self) -> dict[str, Score]:
        """Return the scores by name of the case."""
        return {one.name: one for one in self.scores}


def tables(round_name: str, folder: Path = RESULTS) -> Sequence[Table]:
    """Return the tables of a round, oldest first; the latest one last.

    Raises:
        ValueError: a file is no table; it says which.
    """
    found = []
    for path in sorted((folder / round_name).glob("*.json")):
        try:
            found.append((path.stem == LATEST, msgspec.json.decode(path.read_bytes(), type=Table)))
        except msgspec.DecodeError as error:
            raise ValueError(f"{path}: {error}") from error
    return [table for _, table in sorted(found, key=lambda one: (one[0], one[1].date))]


def keep(round_name: str, name: str, table: Table, folder: Path = RESULTS) -> Path:
    """Write a table under a name, and return its path.

    Raises:
        ValueError: no such round.
        OSError: it cannot be written.
    """
    if round_name not in ROUNDS:
        raise ValueError(f"no round {round_name!r}: {', '.join(ROUNDS)}")
    path = folder / round_name / f"{name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(msgspec.json.format(msgspec.json.encode(table), indent=1) + b"\n")
    return path
