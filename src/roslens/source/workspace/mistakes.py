"""What a manifest should say otherwise although all of it was understood; ``catkin_pkg`` refuses each of it."""

from __future__ import annotations

import msgspec

from roslens.model.source import Location
from roslens.source.workspace.elements import read_elements
from roslens.source.workspace.validity import LOSING, faults_of


class Mistake(msgspec.Struct, frozen=True):
    """A mistake: its kind as in :mod:`~roslens.source.workspace.validity`, and what a message says, with the place.

    Of what is doubled ``other`` is the tag of the element that says the same.
    """

    kind: str
    what: str
    expected: str
    advice: str
    location: Location
    other: str = ""


def mistakes_of(content: bytes, path: str) -> tuple[Mistake, ...]:
    """Return the mistakes in a manifest.

    Args:
        content: of the file.
        path: of the file below the workspace root.
    """
    document = read_elements(content)
    root = document.root
    if root is None or root.tag != "package":
        return ()
    # What was open where the reading ended may have been going to say more.
    torn = {fault.offset for fault in document.faults}
    return tuple(
        Mistake(
            one.kind, one.what, one.expected, one.advice, Location(path, *document.place(one.element.start)), one.other
        )
        for one in faults_of(root, complete=not document.faults)
        if one.kind not in LOSING and (one.element is root or one.element.end not in torn)
    )
