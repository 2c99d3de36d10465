"""What of a package's files was decoded and measured when the package was looked at last, in this process."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.model.entity import Entity
    from roslens.source.measure.analyse_file import FileAnalysis

MOST_BYTES = 48 * 1024 * 1024
"""Of packages whose facts take more as they are kept, nothing is remembered: decoded they take several times that."""


class KnownFile(msgspec.Struct, frozen=True):
    """A file as its content makes it: its analysis and what was measured of it; ``size`` in bytes as it is kept."""

    analysis: FileAnalysis
    entities: tuple[Entity, ...]
    size: int


class RememberedFacts:
    """The files of each package by place and content: who looks at one revision after the other meets most again."""

    def __init__(self) -> None:
        """Remember nothing yet."""
        self._packages: dict[str, dict[tuple[str, str], KnownFile]] = {}

    def of(self, package: str) -> dict[tuple[str, str], KnownFile]:
        """Return the files of the package with this id, by path and key of their facts."""
        return self._packages.get(package, {})

    def remember(self, package: str, files: dict[tuple[str, str], KnownFile]) -> None:
        """Keep the files of a package in place of what was known of it."""
        if sum(one.size for one in files.values()) <= MOST_BYTES:
            self._packages[package] = files
        else:
            self._packages.pop(package, None)
