"""Drivers of devices, as package.xml says: they do not run in simulated time, the computer's clock is right there."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_CLOCKS = frozenset({"node.own_clock", "node.own_clock_python"})
_DRIVER = re.compile(r"(?<![a-z])drivers?(?![a-z])", re.IGNORECASE)


def as_notes_in_drivers(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; a clock of one's own is a note in a package whose name or description is of a driver.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    package = view.package
    is_driver = _DRIVER.search(package.name) is not None or _DRIVER.search(package.description) is not None
    return {path: [_judged(hit, is_driver=is_driver) for hit in hits] for path, hits in placed.items()}


def _judged(hit: Hit, *, is_driver: bool) -> Hit:
    is_meant = is_driver and hit.rule in _CLOCKS
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if is_meant else hit
