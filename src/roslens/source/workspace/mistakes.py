"""Mistakes in a manifest that was understood completely; ``catkin_pkg`` rejects each of them."""

from __future__ import annotations

import msgspec

from roslens.model.source import Location
from roslens.source.workspace.elements import Element, read_elements
from roslens.source.workspace.placeholder import has_placeholder
from roslens.source.workspace.validity import LOSING, faults_of


class Mistake(msgspec.Struct, frozen=True):
    """A mistake: its kind as in :mod:`~roslens.source.workspace.validity`, the parts of its message, and the place.

    For a duplicate, ``other`` is the tag of the equivalent element. ``left_open`` states that it contains a
    placeholder, so that the manifest that is used in the end differs.
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
    # Elements that were open at the end of what could be read may be incomplete.
    torn = {fault.offset for fault in document.faults}
    # Between elements there is no text, but the statements of a template language.
    is_template = has_placeholder(root.text())
    # Each attribute of an element may be a mistake of its own.
    left_open: dict[int, bool] = {}

    def is_left_open(element: Element) -> bool:
        if (known := left_open.get(id(element))) is None:
            known = left_open[id(element)] = _is_left_open(element)
        return known

    return tuple(
        Mistake(
            one.kind,
            one.what,
            one.expected,
            one.advice,
            Location(path, *document.place(one.element.start)),
            one.other,
            is_template or is_left_open(one.element),
        )
        for one in faults_of(root, complete=not document.faults)
        if one.kind not in LOSING and (one.element is root or one.element.end not in torn)
    )


def _is_left_open(element: Element) -> bool:
    return has_placeholder(element.text()) or any(map(has_placeholder, element.attributes.values()))
