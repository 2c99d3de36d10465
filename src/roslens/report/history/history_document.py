"""What was kept of a live system as JSON: ``docs/reference/history.md`` says what it looks like."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.report.history.history_rows import Extract

SCHEMA = 1


def history_json(extracts: Sequence[Extract], units: Mapping[str, str]) -> str:
    """Return one document of all files; the ``at`` of everything counts from the beginning of its file."""
    files = [
        {
            "file": str(one.path),
            "begin": one.begin,
            "since": one.since,
            "until": one.until,
            "series": [
                {
                    "entity": kept.entity,
                    "signal": kept.signal,
                    "unit": units.get(kept.signal, ""),
                    "points": [
                        {"at": point.time - one.begin, "seconds": seconds, **msgspec.to_builtins(point)}
                        for seconds, point in kept.points
                    ],
                }
                for kept in one.series
            ],
            "verdicts": [
                {"at": each.time - one.begin, **msgspec.to_builtins(each), "entity": str(each.entity)}
                for each in one.verdicts
            ],
            "events": [{"at": each.time - one.begin, **msgspec.to_builtins(each)} for each in one.events],
        }
        for one in extracts
    ]
    return msgspec.json.format(msgspec.json.encode({"schema": SCHEMA, "files": files}), indent=2).decode() + "\n"
