"""``--process-metrics``: the Git history of repositories, packages and files."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.history.histories import AskForges
    from roslens.source.history.process_stage import LookBack
    from roslens.source.settings import SourceSettings


def add_process_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--process-metrics``, ``--as-of`` and ``--forge``."""
    parser.add_argument(
        "--process-metrics",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="also measure the Git history: revisions, contributors, churn, ownership, hotspots and more "
        "(default: as `metrics` below [process] in roslens.toml, otherwise not)",
    )
    parser.add_argument(
        "--as-of",
        metavar="DATE",
        help="state ages at this date or time, such as 2026-01-31, instead of at each repository's head",
    )
    parser.add_argument(
        "--forge",
        action="store_true",
        help="with process metrics, also ask GitHub, GitLab, Codeberg or Gitea for the numbers of issues and requests; "
        "tokens come from GITHUB_TOKEN, GITLAB_TOKEN or GITEA_TOKEN",
    )
    parser.add_argument(
        "--forge-host",
        action="append",
        default=[],
        metavar="HOST=KIND",
        help="a further forge that may be asked, and be sent its token: git.example.org=gitlab (github, gitea)",
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


def process_look(options: argparse.Namespace, settings: SourceSettings, answers: Path | None) -> LookBack | None:
    """Return what looks at histories; None where nobody asked.

    Args:
        options: of the command line.
        settings: of the run.
        answers: the file in which answers of forges are kept; None keeps none.

    Raises:
        UsageError: forges are to be asked without process metrics, or one is no forge.
    """
    ask = _asking(options, answers) if getattr(options, "forge", False) else None
    if not settings.process.metrics:
        if ask is not None:
            raise UsageError("--forge without process metrics", expected="--process-metrics --forge")
        return None
    from roslens.source.history.process_stage import look_back

    return look_back(seconds_of(settings.process.as_of) if settings.process.as_of else None, ask)


def _asking(options: argparse.Namespace, kept: Path | None) -> AskForges:
    from importlib.util import find_spec

    from roslens.source.forge.answers import Answers
    from roslens.source.forge.ask_forges import ForgeAnswers, ask_forges
    from roslens.source.forge.forge_client import ForgeClient
    from roslens.source.forge.forge_place import KNOWN, given_forge

    offline = bool(getattr(options, "offline", False))
    if not offline and find_spec("httpx") is None:
        raise UsageError("--forge needs httpx", expected="it to be installed", advice="pip install 'roslens[forge]'")
    try:
        forges = {**KNOWN, **dict(map(given_forge, options.forge_host))}
    except ValueError as error:
        raise UsageError(f"--forge-host {error}", expected="HOST=KIND such as git.example.org=gitlab") from None
    answers = Answers(kept)

    def ask(tops: Sequence[tuple[str, str]]) -> ForgeAnswers:
        try:
            return ask_forges(
                tops, forges, lambda forge: ForgeClient(forge, answers, environment=os.environ, offline=offline)
            )
        finally:
            answers.write()

    return ask


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
