"""What a manifest should say otherwise although all of it was understood; ``catkin_pkg`` refuses each of it."""

from __future__ import annotations

import msgspec

from roslens.model.source import Location
from roslens.source.workspace.elements import Element, read_elements
from roslens.source.workspace.placeholder import has_placeholder
from roslens.source.workspace.validity import LOSING, faults_of


class Mistake(msgspec.Struct, frozen=True):
    """A mistake: its kind as in :mod:`~roslens.source.workspace.validity`, and what a message says, with the place.

    Of what is doubled ``other`` is the tag of the element that says the same. ``left_open`` says that a placeholder
    stands there, so that what reads the manifest in the end reads something else.
    """

    kind: str
    what: str
    expected: str
    advice: str
    location: Location
    other: str = ""
    left_open: bool = False


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
    # Between elements there is no text, but the statements of a template language.
    is_template = has_placeholder(root.text())
    return tuple(
        Mistake(
            one.kind,
            one.what,
            one.expected,
            one.advice,
            Location(path, *document.place(one.element.start)),
            one.other,
            is_template or _is_left_open(one.element),
        )
        for one in faults_of(root, complete=not document.faults)
        if one.kind not in LOSING and (one.element is root or one.element.end not in torn)
    )


def _is_left_open(element: Element) -> bool:
    return has_placeholder(element.text()) or any(map(has_placeholder, element.attributes.values()))
