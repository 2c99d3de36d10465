"""A configuration for people: each node with what it publishes, subscribes, serves, calls and takes, and from where."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    Missing,
    Origin,
    Proof,
    Standing,
    Unresolved,
)
from roslens.model.graph import Role
from roslens.model.graphs.completeness import completeness_of
from roslens.model.qos import quality_text
from roslens.report.writing.terminal import printable

_HEADS = (
    (Role.PUBLISHER, "publishes"),
    (Role.SUBSCRIPTION, "subscribes"),
    (Role.SERVICE_SERVER, "serves"),
    (Role.SERVICE_CLIENT, "calls"),
    (Role.ACTION_SERVER, "serves actions"),
    (Role.ACTION_CLIENT, "calls actions"),
)
_OF_EVERY_NODE = frozenset({"use_sim_time", "start_type_description_service"})
"""Parameters that every node of ROS 2 takes, whatever its own code says."""

_LONGEST = 60
_LONGEST_REASON = 120


def to_graph_text(configuration: Configuration) -> str:
    """Return what is started as lines; marks are explained in the last one where there are any."""
    lines = [*_head(configuration)]
    unknown = {one.proof.place for one in configuration.unresolved}
    for one in configuration.nodes:
        lines += ["", *_node(one, configuration.generation, set_by_unknown=one.proof.place in unknown)]
    lines += unresolved_lines(configuration.unresolved)
    if any("? " in line or "~ " in line for line in lines):
        lines += ["", "? a part of the name is unknown, * replaces it   ~ likely, but not certain"]
    return "".join(f"{printable(line)}\n" for line in lines)


def unresolved_lines(missed: Sequence[Unresolved]) -> Iterator[str]:
    """Yield what is unresolved, the users' own code first; what is in vendored and generated code is counted."""
    if not missed:
        return
    yield ""
    failing = sum(one.standing is Standing.FAILURE for one in missed)
    yield f"unresolved: {len(missed)}{f', of which {failing} certain to fail' if failing else ''}"
    own = sorted((one for one in missed if not one.role), key=lambda one: one.standing is not Standing.FAILURE)
    yield from _unresolved(folded_by_file([one for one in own if one.missing is not Missing.NAMED_ALIKE]))
    alike = sum(one.missing is Missing.NAMED_ALIKE for one in own)
    if alike:
        yield f"  and {alike} calls of functions of the workspace named as what makes an endpoint, which make none"
    for role in ("test", "generated", "vendored"):
        count = sum(one.role == role for one in missed)
        if count:
            yield f"  and {count} in {role} code, listed by --format json"


def folded_by_file(missed: Sequence[Unresolved]) -> list[Unresolved]:
    """Return what is unresolved of code, each reason once for a file, at the first place where it is so."""
    places: dict[tuple[str, str, str], list[Unresolved]] = {}
    for one in missed:
        places.setdefault((one.proof.path, one.reason, one.node), []).append(one)
    found = []
    for group in places.values():
        first, more = group[0], len(group) - 1
        if first.node or not more:
            found += group
        else:
            found.append(msgspec.structs.replace(first, reason=f"{first.reason}; and {more} more in this file"))
    return found


_STANDING = {one: "" if one is Standing.UNDECIDABLE else f" ({one.value})" for one in Standing}


def _unresolved(missed: Sequence[Unresolved]) -> Iterator[str]:
    """Yield a line for each, but one for a node together with the names below it that depend on the same."""
    causes = {(one.node, one.cause): [one] for one in missed if one.missing is Missing.NODE_NAME}
    for one in missed:
        if one.missing is Missing.ENDPOINT_NAME and (one.node, one.cause) in causes:
            causes[one.node, one.cause].append(one)
    repeated = {id(one) for same in causes.values() for one in same[1:]}
    for one in missed:
        if id(one) in repeated:
            continue
        below = len(causes[one.node, one.cause]) - 1 if one.missing is Missing.NODE_NAME else 0
        node = f"{one.node}: " if one.node else ""
        text = f' "{_short(one.text)}"' if one.text else ""
        more = f", and {below} of its endpoints with it" if below > 0 else ""
        yield f"  {one.proof.place}  {node}{one.reason}{more}{text}{_STANDING[one.standing]}"


def _head(configuration: Configuration) -> Iterator[str]:
    names = {one.endpoint.name for node in configuration.nodes for one in node.endpoints if _is_topic(one)}
    nodes = counted(len(configuration.nodes), "node")
    yield f"{configuration.title}: {configuration.generation}, {nodes}, {counted(len(names), 'topic')}"
    known = completeness_of(configuration)
    if not known.is_whole and (known.nodes or known.missing):
        yield f"  {known.said()}"
        yield from (f"    {line}" for line in known.why())
    if configuration.arguments:
        yield "  arguments and their defaults"
        for argument in configuration.arguments:
            default = "must be given" if argument.default is None else f'"{argument.default}"'
            about = f"  {argument.description}" if argument.description else ""
            yield f"    {argument.name}: {default}{about}"
    yield from _parameters("parameters of all nodes", configuration.parameters)


def counted(count: int, what: str) -> str:
    """Return a number of things: ``1 node``, ``2 nodes``."""
    return f"{count} {what}{'s' * (count != 1)}"


def _is_topic(one: ConfiguredEndpoint) -> bool:
    return one.endpoint.role in (Role.PUBLISHER, Role.SUBSCRIPTION)


def _node(node: ConfiguredNode, generation: str, *, set_by_unknown: bool) -> Iterator[str]:
    yield _title(node)
    if node.defined is not None:
        yield f"  defined in {_from(node.defined)}"
    for condition in dict.fromkeys(node.conditions):
        yield f"  if {condition}"
    if node.machine:
        yield f"  on {node.machine}"
    yield from endpoint_lines(node.endpoints)
    if node.linked:
        places = ", ".join(dict.fromkeys(one.place for one in node.linked))
        yield f"  its endpoints are unknown; it may create those that no known program starts: {places}"
    # Where a part of what starts a node is unknown, as a file of parameters, other values may hold.
    head = "parameters, as far as is known" if set_by_unknown else "parameters"
    yield from _parameters(head, node.parameters, _taken_anyway(node, generation, set_by_unknown=set_by_unknown))
    remaps = [one for one in node.remaps if not one.used]
    if remaps:
        yield "  remappings that match nothing" + (", as far as is known" if any(r.uncertain for r in remaps) else "")
        yield from _aligned([(f"{one.source} to {one.target}", one.proof.place) for one in remaps])


def _title(node: ConfiguredNode) -> str:
    what = "/".join(one for one in (node.package, node.executable) if one)
    about = [what, node.kind if node.kind != "node" else "", f"in {node.container}" if node.container else ""]
    mark = ("~ " if node.proof.sure != "certain" else "") if node.resolved else "? "
    why = f"  ({_short(node.proof.how, _LONGEST_REASON)})" if mark == "~ " and node.proof.how else ""
    return f"{mark}{node.name}  ({', '.join(one for one in about if one)})  {node.proof.place}{why}"


def _taken_anyway(node: ConfiguredNode, generation: str, *, set_by_unknown: bool) -> frozenset[str]:
    """Return the parameters of which it is not worth saying that no code is known to take them."""
    without_code = node.defined is None and set_by_unknown
    if without_code or (node.defined is not None and node.defined.origin is Origin.CATALOGUE):
        # What takes them is not read at all, which is said once.
        return frozenset(one.name for one in node.parameters)
    return _OF_EVERY_NODE if generation == "ros2" else frozenset()


def endpoint_lines(endpoints: Sequence[ConfiguredEndpoint]) -> Iterator[str]:
    """Yield endpoints by what they do."""
    for role, head in _HEADS:
        ends = [one for one in endpoints if one.endpoint.role is role]
        if ends:
            yield f"  {head}"
            yield from _aligned([_end(one) for one in ends])


def _end(one: ConfiguredEndpoint) -> tuple[str, ...]:
    mark = "" if one.resolved else "? "
    mark = mark or ("~ " if one.proof.sure != "certain" else "")
    notes = [f"if {_short(condition)}" for condition in one.conditions]
    if one.remapped is not None:
        notes.append(f'remapped from "{one.given}" in {one.remapped.place}')
    if one.proof.how and one.proof.origin is not Origin.IMPLICIT:
        notes.append(_short(one.proof.how, _LONGEST_REASON))
    note = f"  ({'; '.join(notes)})" if notes else ""
    quality = quality_text(one.endpoint.qos) if one.endpoint.qos else _queue(one)
    return mark + one.endpoint.name, one.endpoint.type or "type unknown", quality, _from(one.proof) + note


def _queue(one: ConfiguredEndpoint) -> str:
    pieces = [f"queue {one.queue}" if one.queue >= 0 else "", "latched" if one.latched else ""]
    return ", ".join(piece for piece in pieces if piece)


def _from(proof: Proof) -> str:
    if proof.origin is Origin.CATALOGUE:
        return f"catalogue: {proof.path}"
    if proof.origin is Origin.IMPLICIT:
        return proof.how
    return proof.place


def _parameters(
    head: str, parameters: Sequence[ConfiguredParameter], everywhere: frozenset[str] = frozenset()
) -> Iterator[str]:
    if not parameters:
        return
    listed = [one for one in parameters if not one.repeats_an_endpoint]
    rows = [_parameter(one, everywhere=one.name in everywhere) for one in listed]
    if len(listed) < len(parameters):
        rows.append((f"qos_overrides.* ({len(parameters) - len(listed)})", "", "", "as stated at the endpoints above"))
    yield f"  {head}"
    yield from _aligned(rows)


def _parameter(one: ConfiguredParameter, *, everywhere: bool) -> tuple[str, ...]:
    value = "?" if one.value is None else _value(one.value)
    doubtful = one.proof is not None and one.proof.sure != "certain"
    name = f"{'? ' if '*' in one.name else '~ ' if doubtful else ''}{one.name}"
    notes = ", ".join(note for note in _notes(one, everywhere=everywhere) if note)
    return name, f"= {value}", notes, _places(one)


def _notes(one: ConfiguredParameter, *, everywhere: bool) -> Iterator[str]:
    yield one.type or one.set_type
    if one.access == "" and one.proof is None and not everywhere:
        yield "set, but no code is known to take it"
    written = one.written_by
    if one.set_by is None and written is not None and one.access != "declared" and written.how:
        yield f"{written.sure}: {written.how}"


def _places(one: ConfiguredParameter) -> str:
    if one.set_by is not None:
        default = "" if one.default is None else f", default {_value(one.default)}"
        return f"set in {one.set_by.place}{_also(one.written_by)}{default}"
    if one.written_by is not None and one.access == "declared":
        return f"{_from(one.proof)} by {one.written_by.place}" if one.proof else one.written_by.place
    return _from(one.proof) if one.proof else ""


def _value(text: str) -> str:
    return _short(text) or '""'


def _also(written: Proof | None) -> str:
    return "" if written is None else f", written in {written.place}{': ' * bool(written.how)}{written.how}"


def _short(text: str, longest: int = _LONGEST) -> str:
    line = " ".join(text.split())
    return line if len(line) <= longest else line[: longest - 1] + "…"


def _aligned(rows: Iterable[tuple[str, ...]]) -> Iterator[str]:
    table = list(rows)
    count = max(map(len, table), default=0)
    widths = [min(max((len(row[place]) for row in table if place < len(row)), default=0), 48) for place in range(count)]
    for row in table:
        yield ("    " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=False))).rstrip()
