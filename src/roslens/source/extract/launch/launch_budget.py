"""A launch file that takes more than a file may: what it would start is not known, and the others are followed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.launch_failures import Failures


class Miss(Protocol):
    """Notes what could not be evaluated, and that it may start further nodes."""

    def __call__(self, text: str, evidence: Evidence, reason: str, *, opens: bool) -> None:
        """Note it."""


@contextmanager
def within_budget(miss: Miss, failures: Failures, path: str, evidence: Evidence, size: int = 1 << 20) -> Iterator[None]:
    """Let what is done inside take what a file may; where it takes more, that is noted, and nothing is raised."""
    try:
        with file_budget(path, size=size):
            yield
    except OverBudgetError as error:
        failures.is_cut = True
        miss(error.subject or path, evidence, str(error), opens=True)
