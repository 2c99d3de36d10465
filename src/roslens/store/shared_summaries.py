"""Summaries of packages in many runs: a package that did not change from one run to the next is read once."""

from __future__ import annotations

import sqlite3
from collections import defaultdict
from collections.abc import Sequence

import msgspec

from roslens.model.result import PackageSummary
from roslens.store import rows


def read_summaries(connection: sqlite3.Connection, runs: Sequence[int]) -> dict[int, tuple[PackageSummary, ...]]:
    """Return the summaries of each run, with what only all packages together show among their values."""
    wanted = (rows.to_json(list(runs)),)
    units = {
        unit: rows.to_summary(text)
        for unit, text in connection.execute(
            "SELECT id, summary FROM unit WHERE key IS NOT NULL AND package <> '' AND id IN "
            "(SELECT unit FROM run_unit WHERE run IN (SELECT value FROM json_each(?)))",
            wanted,
        )
    }
    values: dict[int, dict[str, dict[str, float]]] = defaultdict(lambda: defaultdict(dict))
    for run, package, quantity, value in connection.execute(
        "SELECT run, package, quantity, value FROM package_value WHERE run IN (SELECT value FROM json_each(?))", wanted
    ):
        values[run][package][quantity] = value
    found: dict[int, list[PackageSummary]] = {run: [] for run in runs}
    for run, unit in connection.execute(
        "SELECT run, unit FROM run_unit WHERE run IN (SELECT value FROM json_each(?)) ORDER BY run, position", wanted
    ):
        if (one := units.get(unit)) is not None:
            more = values[run].get(one.id)
            found[run].append(msgspec.structs.replace(one, values={**one.values, **more}) if more else one)
    return {run: tuple(summaries) for run, summaries in found.items()}
