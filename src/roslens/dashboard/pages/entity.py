"""Where the page of an entity is: the way from what runs, which knows names alone, to what was read of its source."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import ref_of
from roslens.dashboard.site import Site

_OF_GRAPH = {"node": "node", "topic": "topic", "service": "topic", "action": "topic"}


def page_of(site: Site, entity: str) -> PageRef | None:
    """Return the page of an entity by the text form of its id, ``kind:name``; None where the run knows none.

    Of a node, topic, service or action it is that of the first configuration that has it; of a connection, that of its
    topic.
    """
    kind, _, name = entity.partition(":")
    if kind == "connection" and len(ends := name.split(" > ")) == 3:
        kind, name = "topic", ends[1]
    if kind == "parameter":
        kind, name = "node", name.partition(":")[0]
    if kind in _OF_GRAPH and (found := element_page(site, kind, name)) is not None:
        return found
    if kind == "package" and name in site.by_id:
        return PageRef("package", name)
    if kind in {"file", "class", "function"} and name.partition("#")[0] in site.places:
        return PageRef("file", name.partition("#")[0])
    return None


def element_page(site: Site, kind: str, name: str) -> PageRef | None:
    """Return the page of a node, topic, service or action of that name; None where no configuration has one."""
    for system in site.book.systems.values():
        for element in system.elements:
            if element.name == name and element.kind.value == kind and (ref := ref_of(system, element)) is not None:
                return ref
    return None
