"""Where the evaluation of a launch file meets what ends the launch with an error.

What is certain depends on what was followed: behind a file or an action that is not, anything may be set.
"""

from __future__ import annotations

from roslens.model.configuration import Standing
from roslens.source.extract.facts.launched import Failed, Fault, ParameterFileUse
from roslens.source.extract.facts.node_facts import Evidence

MOST_FAILED = 500
"""Of one evaluation; a file with more repeats itself."""


class Failures:
    """Collects failures, each once.

    Attributes:
        at: the action that is visited.
        is_open: whether it is visited under conditions only that are not known.
        is_opaque: whether something before was not followed, which may set launch configurations.
        is_cut: whether a budget ended something.
    """

    def __init__(self) -> None:
        """Begin with an evaluation."""
        self.at = Evidence("", 0)
        self.is_open = False
        self.is_opaque = False
        self.is_cut = False
        self._failed: dict[Failed, None] = {}
        self._raw_files: dict[ParameterFileUse, None] = {}
        self._through: list[Evidence] = []

    @property
    def failed(self) -> tuple[Failed, ...]:
        """The failures in the order in which they were met."""
        return tuple(self._failed)

    @property
    def raw_files(self) -> tuple[ParameterFileUse, ...]:
        """The files of parameters that rcl reads as they are."""
        return tuple(self._raw_files)

    @property
    def include(self) -> Evidence:
        """Where the file that is followed is included."""
        return self._through[-1] if self._through else self.at

    def enter(self, include: Evidence) -> None:
        """Follow a file that is included at a place."""
        self._through.append(include)

    def leave(self) -> None:
        """End with a file."""
        self._through.pop()

    def report(self, fault: Fault, text: str, reason: str, at: Evidence | None = None) -> Standing:
        """Note a failure; return what is known of it."""
        if fault is Fault.NOT_SET and self.is_opaque:
            return Standing.UNDECIDABLE
        if len(self._failed) < MOST_FAILED:
            self._failed[Failed(fault, text, at or self.at, reason, self.is_open, tuple(self._through[1:]))] = None
        return Standing.FAILURE

    def given(self, path: str, evidence: Evidence) -> None:
        """Note that a node is given a file of parameters."""
        self._raw_files[ParameterFileUse(path, evidence)] = None
