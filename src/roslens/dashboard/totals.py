"""Where a file belongs, and how often a rule was broken in all packages."""

from __future__ import annotations

import msgspec

from roslens.model.finding import Severity
from roslens.model.source import SourceFile


class FilePlace(msgspec.Struct, frozen=True):
    """A file and the package it belongs to."""

    package: str
    file: SourceFile


class RuleTotal(msgspec.Struct, frozen=True):
    """How often a rule was broken in all packages, and in how many."""

    rule: str
    severity: Severity
    tags: tuple[str, ...]
    count: int
    gated: int
    packages: int
