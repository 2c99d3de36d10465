"""Which past revisions are looked at."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import datetime, timezone
from typing import Literal

import msgspec

from roslens.model.process import Release
from roslens.source.history.commit_log import Commit, CommitLog

Period = Literal["release", "month", "week", "day"]
PERIODS: tuple[Period, ...] = ("release", "month", "week", "day")
FORMS = {"month": "%Y-%m", "week": "%G-%V", "day": "%Y-%m-%d"}
"""How the time of a commit names the period that it is in."""


class Every(msgspec.Struct, frozen=True):
    """How often one looks: at each release, at the last commit of a period, or at each so-manieth commit."""

    period: Period | None = None
    step: int = 1

    @classmethod
    def parse(cls, text: str) -> Every:
        """Read what a user gives.

        Raises:
            ValueError: it is neither a period nor a positive number.
        """
        if text in PERIODS:
            return cls(text)
        if re.fullmatch(r"[1-9]\d{0,8}", text):
            return cls(None, int(text))
        raise ValueError(f"{text!r} is neither one of {', '.join(PERIODS)} nor a positive number")


def chosen_revisions(
    log: CommitLog, released: Sequence[Release], every: Every, *, since_s: float | None = None
) -> list[Commit]:
    """Return the commits to look at, the oldest first; the head is always the last of them.

    Of releases these are the tagged commits wherever they are behind the head; otherwise commits of the main line,
    which is that of first parents.

    Args:
        log: of the head.
        released: releases behind the head.
        every: how often.
        since_s: without commits before this time, in seconds since 1970.
    """
    if every.period == "release":
        tagged = {one.commit for one in released}
        found = [commit for number, commit in enumerate(log.commits) if commit.id in tagged or number == 0]
    elif every.period is not None:
        found = list(last_of_each(main_line(log), FORMS[every.period]))
    else:
        found = main_line(log)[:: every.step]
    return [one for one in reversed(found) if since_s is None or one.time_s >= since_s]


def main_line(log: CommitLog) -> list[Commit]:
    """Return the head, its first parent, the first parent of that, and so on."""
    by_id = {commit.id: commit for commit in log.commits}
    found = []
    current = log.head
    while current is not None:
        found.append(current)
        current = by_id.get(current.parents[0]) if current.parents else None
    return found


def last_of_each(newest_first: Sequence[Commit], form: str) -> Iterator[Commit]:
    """Yield the last commit of each period."""
    seen = set()
    for commit in newest_first:
        period = datetime.fromtimestamp(commit.time_s, tz=timezone.utc).strftime(form)
        if period not in seen:
            seen.add(period)
            yield commit
