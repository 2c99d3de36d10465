"""A launch file that takes more than a file may: what it would start is not known, and the others are followed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.launch_failures import Failures

Result = TypeVar("Result")


class Miss(Protocol):
    """Notes what could not be evaluated, and that it may start further nodes."""

    def __call__(self, text: str, evidence: Evidence, reason: str, *, opens: bool) -> None:
        """Note it."""


def within_budget(
    miss: Miss, failures: Failures, path: str, evidence: Evidence, read: Callable[[], Result], size: int = 1 << 20
) -> Result | None:
    """Return what ``read`` does within what a file may take; where it takes more, that is noted, and there is nothing.

    A file that is known to take more is not read.
    """
    try:
        with file_budget(path, size=size):
            return read()
    except OverBudgetError as error:
        failures.is_cut = True
        miss(error.subject or path, evidence, str(error), opens=True)
        return None
