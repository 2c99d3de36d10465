"""``--process-metrics``: what git's history says of repositories, packages and files."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.history.process_stage import LookBack
    from roslens.source.settings import SourceSettings


def add_process_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--process-metrics`` and ``--as-of``."""
    parser.add_argument(
        "--process-metrics",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="also measure what git's history says: revisions, contributors, churn, ownership, hotspots and more "
        "(default: as `metrics` below [process] in roslens.toml says, else not)",
    )
    parser.add_argument(
        "--as-of",
        metavar="DATE",
        help="tell ages at this date or time, such as 2026-01-31, instead of at each repository's head",
    )


def with_process(options: argparse.Namespace, settings: SourceSettings) -> SourceSettings:
    """Return the settings with what the command line says of process metrics.

    Raises:
        UsageError: the date is none.
    """
    import msgspec

    process = settings.process
    if (wanted := getattr(options, "process_metrics", None)) is not None:
        process = msgspec.structs.replace(process, metrics=wanted)
    if as_of := getattr(options, "as_of", None):
        process = msgspec.structs.replace(process, as_of=as_of)
    if process.as_of:
        seconds_of(process.as_of)
    return msgspec.structs.replace(settings, process=process)


def process_look(settings: SourceSettings) -> LookBack | None:
    """Return what looks at histories; None where nobody asked."""
    if not settings.process.metrics:
        return None
    from roslens.source.history.process_stage import look_back

    return look_back(seconds_of(settings.process.as_of) if settings.process.as_of else None)


def seconds_of(text: str) -> float:
    """Return the seconds since 1970 of a date or time in ISO 8601; UTC where it names no zone.

    Raises:
        UsageError: it is none.
    """
    from datetime import datetime, timezone

    try:
        found = datetime.fromisoformat(text.replace("Z", "+00:00"))
    except ValueError:
        raise UsageError(f"as_of {text!r}", expected="a date or time such as 2026-01-31 or 2026-01-31T08:00Z") from None
    return (found if found.tzinfo else found.replace(tzinfo=timezone.utc)).timestamp()
