"""What a team decided about findings, as pages show it and as who operates changes it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import msgspec

LONGEST_REASON = 500


class Reviewed(msgspec.Struct, frozen=True):
    """A finding that was looked at and stays.

    Attributes:
        fingerprint: of the finding when it was accepted.
        state: ``accepted`` or ``false_positive``.
        reason: why it stays.
        rule: that found it.
        path: of its file.
        message: its text.
    """

    fingerprint: str
    state: str
    reason: str
    rule: str = ""
    path: str = ""
    message: str = ""

    @property
    def word(self) -> str:
        """The state as people read it."""
        return "called false" if self.state == "false_positive" else "accepted"


class Review(Protocol):
    """The file of accepted findings of a workspace."""

    def entries(self) -> Mapping[str, Reviewed]:
        """Return the current content of the file, by fingerprint."""

    def accept(self, fingerprint: str, reason: str, *, false_positive: bool) -> str:
        """Write that a finding of the run stays; return why not, if not."""

    def undo(self, fingerprint: str) -> str:
        """Take that back; return why not, if not."""
