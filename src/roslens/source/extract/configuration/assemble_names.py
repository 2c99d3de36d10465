"""Names that an assembled node is given: by the user, by what it is loaded into, and why one is not known."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.environment_defaults import supposed_name
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.node_facts import EndpointFact
from roslens.source.extract.facts.resolve_name import TOP, Place, below, expand
from roslens.source.extract.symbolic.text import Text


def as_hinted(fact: EndpointFact, names: dict[str, str]) -> EndpointFact:
    """Return an endpoint with the name that the user gives to what is made at its place."""
    name = names.get(f"{fact.evidence.path}:{fact.evidence.line}")
    return fact if name is None else msgspec.structs.replace(fact, name=Text.of(name))


def container_name(launched: Launched, generation: str) -> str:
    """Return the resolved name of the container or manager that something is loaded into; empty where it has none."""
    if not launched.container.parts:
        return ""
    namespace = launched.namespace if generation == "ros1" else TOP
    place = Place(namespace, below(namespace, launched.name), generation)
    return supposed_name(expand(launched.container, place)).pattern


def why_unknown(text: Text) -> str:
    """Return in words why a text is not known."""
    return "; ".join(dict.fromkeys(str(hole.reason) for hole in text.holes))
