"""Code that makes endpoints and that no known program starts, for people: by package, what makes what and where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.model.graph import Role
from roslens.model.unstarted import REASONS
from roslens.report.graph.graph_text import counted, endpoint_lines, unresolved_lines
from roslens.report.writing.terminal import printable

VERBS = {
    Role.PUBLISHER: "publishes",
    Role.SUBSCRIPTION: "subscribes to",
    Role.SERVICE_SERVER: "serves",
    Role.SERVICE_CLIENT: "calls",
    Role.ACTION_SERVER: "serves action",
    Role.ACTION_CLIENT: "calls action",
}


def to_unstarted_text(configuration: Configuration) -> str:
    """Return what nothing starts as lines; vendored code is counted."""
    own = [one for one in configuration.nodes if not one.role]
    ends = sum(len(one.endpoints) for one in configuration.nodes)
    lines = [f"{configuration.title}: {configuration.generation}, {counted(ends, 'endpoint')}, likely at most"]
    for package, nodes in groupby(own, lambda one: one.package):
        lines += ["", f"{package}", *_package(tuple(nodes))]
    others = [one for one in configuration.nodes if one.role]
    if others:
        places = sum(len(one.endpoints) for one in others)
        lines += ["", f"and {counted(places, 'endpoint')} of vendored, generated or test code, listed by --format json"]
    # What is unknown of the name of an endpoint is marked there.
    lines += unresolved_lines([one for one in configuration.unresolved if not one.node])
    lines += ["", "? a part of the name is unknown, * replaces it; the name of the node is one of them"]
    return "".join(f"{printable(line)}\n" for line in lines)


def unstarted_packages(configuration: Configuration) -> Iterator[tuple[str, list[str]]]:
    """Yield the packages whose own code makes endpoints that nothing starts, each with a line for each unit and end."""
    own = [one for one in configuration.nodes if not one.role and one.endpoints]
    for package, nodes in groupby(own, lambda one: one.package):
        lines = []
        for one in nodes:
            lines.append(f"{unit_name(one)}, {REASONS.get(one.kind, one.kind)}:")
            for end in one.endpoints:
                type_ = f" ({end.endpoint.type})" if end.endpoint.type else ""
                does = VERBS[end.endpoint.role]
                lines.append(f"  {does} {end.endpoint.name}{type_} at {end.proof.place}")
        yield package, [printable(line) for line in lines]


def unit_name(one: ConfiguredNode) -> str:
    """Return what makes endpoints: a class or function as its language writes it, else its file or plug-in."""
    place = one.defined.place if one.defined is not None else one.proof.place
    unit = "" if one.unit in ("main", "<module>") else one.unit.replace(".", "::" if _is_cpp(place) else ".")
    return unit or one.executable


def _package(nodes: Sequence[ConfiguredNode]) -> Iterator[str]:
    for one in nodes:
        place = one.defined.place if one.defined is not None else one.proof.place
        loaded = f", loaded as {one.executable}" if one.kind == "plugin" else ""
        described = f" in {one.proof.place}" if loaded and one.proof.place != place else ""
        yield f"  {one.kind} {unit_name(one)}{loaded}{described}  {place}"
        # What is so of all of them stands in the title.
        certain = (
            msgspec.structs.replace(end, proof=msgspec.structs.replace(end.proof, how="", sure="certain"))
            for end in one.endpoints
        )
        yield from (f"  {line}" for line in endpoint_lines(tuple(certain)))


def _is_cpp(place: str) -> bool:
    return not place.partition(":")[0].endswith(".py")
