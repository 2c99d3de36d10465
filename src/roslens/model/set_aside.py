"""Findings that were set aside, and why."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.finding import Finding


class Disposition(str, Enum):
    """Who set a finding aside, and how."""

    SUPPRESSED = "suppressed"
    """A comment in the source."""
    IGNORED = "ignored"
    """An ``[[ignore]]`` in the configuration."""
    ACCEPTED = "accepted"
    """The file of accepted findings: it is true, and stays."""
    FALSE_POSITIVE = "false_positive"
    """The file of accepted findings: it is not true."""


class SetAside(msgspec.Struct, frozen=True, omit_defaults=True):
    """A finding that is kept with a run but counts nowhere.

    ``reason`` is as its author wrote it. ``by`` is where that stands: ``path:line`` of a comment, ``[[ignore]] 2`` for
    the second of the configuration, or the fingerprint under which the finding was accepted. ``package`` is the id of
    its package, empty for none.
    """

    finding: Finding
    state: Disposition
    reason: str = ""
    by: str = ""
    package: str = ""
