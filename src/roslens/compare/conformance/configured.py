"""Source as one side of a comparison: the claims of a configuration."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, Claim, surest
from roslens.compare.conformance.policies import policies
from roslens.compare.conformance.side import Beside, Side, SideKind
from roslens.compare.conformance.topics import topics_of
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, ConfiguredParameter


def source_side(configuration: Configuration, title: str = "", beside: Sequence[Beside] = ()) -> Side:
    """Return a configuration as a side; ``beside`` is what else its workspace has."""
    claims = claims_of(configuration)
    opening = next((one for one in configuration.unresolved if one.opens), None)
    unread: dict[str, str] = {}
    for one in configuration.unresolved:
        if one.node:
            unread.setdefault(one.node, f"{one.proof.place}: {one.reason}")
    return Side(
        SideKind.SOURCE,
        title or configuration.title,
        claims,
        generation=configuration.generation,
        open=f"{opening.proof.place}: {opening.reason}" if opening else "",
        unread=unread,
        beside=tuple(beside),
        graph=configuration.graph(),
    )


def claims_of(configuration: Configuration) -> tuple[Claim, ...]:
    """Return the claims of a configuration.

    A nodelet's endpoints are those of its manager. In ROS 1 a parameter is one of the parameter server: what is only
    read is not there. In ROS 2 it is one of a node, and what is set without being declared is said to be ignored.
    """
    ros1 = configuration.generation == "ros1"
    names = {node.name for node in configuration.nodes}
    found: list[Claim] = []
    for node in map(_ended, configuration.nodes):
        if node.kind == "process" and not node.endpoints:
            continue
        inside = node.container if node.kind == "nodelet" and node.container in names else ""
        if not inside or any(one.implicit for one in node.endpoints):
            found.append(_node(node))
        found += (_endpoint(one, node.name if one.implicit else inside or node.name, node) for one in node.endpoints)
        found += _parameters(node.parameters, node, ros1=ros1)
    if ros1:
        found += _parameters(configuration.parameters, None, ros1=True)
    claims = surest(found)
    return surest((*claims, *topics_of(claims)))


def _ended(node: ConfiguredNode) -> ConfiguredNode:
    """Return a node whose name only lacks its random end as one whose name is known."""
    if not (node.anonymous and node.name.count("*") == 1 and node.name.endswith("_*")):
        return node
    ends = [
        msgspec.structs.replace(
            one, resolved=one.endpoint.name.count("*") <= int(one.endpoint.name.startswith(node.name))
        )
        for one in node.endpoints
    ]
    return msgspec.structs.replace(node, resolved=True, endpoints=tuple(ends))


def _node(node: ConfiguredNode) -> Claim:
    program = "/".join(part for part in (node.package, node.executable) if part)
    return Claim(
        NODE, node.name, values={"program": program} if program else {}, sure=node.proof.sure, resolved=node.resolved,
        conditions=node.conditions, place=node.proof.place,
    )  # fmt: skip


def _endpoint(one: ConfiguredEndpoint, node: str, of: ConfiguredNode) -> Claim:
    end = one.endpoint
    known = one.resolved and of.resolved
    values = {"type": end.type} if end.type and "*" not in end.type else {}
    if end.qos is not None:
        values |= policies(end.qos, certain=not one.qos_unknown or one.implicit)
    return Claim(
        end.role.value, node, end.name, values, one.proof.sure if known else "possible", known, one.implicit,
        tuple(dict.fromkeys((*of.conditions, *one.conditions))), one.proof.place, one.given,
        one.remapped.place if one.remapped else "", uncertain=one.qos_unknown,
    )  # fmt: skip


def _parameters(parameters: Iterable[ConfiguredParameter], of: ConfiguredNode | None, *, ros1: bool) -> Iterator[Claim]:
    for one in parameters:
        if _is_there(one, ros1=ros1):
            yield _parameter(one, of, ros1=ros1)


def _parameter(one: ConfiguredParameter, of: ConfiguredNode | None, *, ros1: bool) -> Claim:
    proof = one.written_by or one.set_by or one.proof
    return Claim(
        PARAMETER, "" if ros1 or of is None else of.name, one.name,
        {} if one.value is None else {"value": one.value}, _sure(one, ros1=ros1),
        "*" not in one.name and (of is None or of.resolved), conditions=_conditions(one, of, ros1=ros1),
        place=proof.place if proof else "", ignored=not ros1 and one.access == "",
        uncertain="something that is not known may set it too" if one.uncertain else "",
    )  # fmt: skip


def _is_there(one: ConfiguredParameter, *, ros1: bool) -> bool:
    """Whether a parameter is there once all is started: set, or in ROS 2 declared."""
    if one.repeats_an_endpoint:
        return False
    if one.set_by is not None or one.written_by is not None:
        return True
    return one.access == "declared" and not ros1


def _sure(one: ConfiguredParameter, *, ros1: bool) -> str:
    proof = one.written_by or one.set_by or one.proof
    sure = proof.sure if proof else "likely"
    has_default = one.set_by is None and one.default is not None and not ros1
    return "certain" if has_default and sure == "likely" else sure


def _conditions(one: ConfiguredParameter, of: ConfiguredNode | None, *, ros1: bool) -> tuple[str, ...]:
    """Return under what a parameter is there; in ROS 1 a set one is, whatever its node comes to."""
    of_node = of.conditions if of else ()
    return of_node if one.set_by and ros1 else (*of_node, *one.conditions)
