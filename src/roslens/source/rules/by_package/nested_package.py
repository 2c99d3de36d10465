"""Packages in the folder of another package: neither colcon nor catkin looks for packages there.

What their package.xml and their CMakeLists.txt say is of no use until somebody moves them, or builds them by
themselves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_FAMILIES = ("package.", "cmake.")


def as_notes_in_nested_package(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what manifest and build say is a note in a package inside of another one.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    if not view.around.inside:
        return {path: list(hits) for path, hits in placed.items()}
    return {path: [_as_note(hit) for hit in hits] for path, hits in placed.items()}


def _as_note(hit: Hit) -> Hit:
    is_of_build = hit.rule.startswith(_FAMILIES)
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if is_of_build else hit
