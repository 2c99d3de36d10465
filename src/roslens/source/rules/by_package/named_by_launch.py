"""Names of nodes in sources of ROS 1 that launch files of the package replace before roscpp looks at them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_RULE = "node.node_name"


def as_notes_where_launch_names(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; a name that ROS 1 refuses is a note in a package whose launch files start its nodes.

    ``<node>`` requires ``name``, which roslaunch hands over as ``__name``: only ``rosrun`` still meets the exception.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    flagged = [path for path, hits in found.items() if any(hit.rule == _RULE for hit in hits)]
    if flagged and view.ros == {1} and _starts_its_nodes(view):
        for path in flagged:
            found[path] = [_as_note(hit) for hit in found[path]]
    return found


def _starts_its_nodes(view: PackageView) -> bool:
    return any(
        element.tag == "node" and element.attributes.get("pkg") == view.package.name
        for file in view.launch
        for element, _ in file.elements
    )


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if hit.rule == _RULE else hit
