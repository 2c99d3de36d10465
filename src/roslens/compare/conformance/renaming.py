"""The same node or endpoint under another name: reported as one difference, not as one that went and one that came."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence, Set
from fnmatch import fnmatchcase

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, Claim
from roslens.compare.conformance.plumbing import plumbing, tool

ALIKE = 0.6
"""Share of what two nodes have together that both must have to be one."""
_LEAST = 1
_MOST_ALIKE = 20
"""The largest number of nodes that may share a part for it to still distinguish them from all others."""

_Part = tuple[str, str, str]


def known_by_pattern(claims: Sequence[Claim], patterns: Sequence[Claim]) -> tuple[Claim, ...]:
    """Return claims with the names of nodes that get a random end as source gives them: with ``*`` in its place."""
    ends = [one.node for one in patterns if one.kind == NODE and one.node.endswith("_*")]
    there = {one.node for one in claims if one.kind == NODE}
    names: dict[str, str] = {}
    for node in there:
        fits = [pattern for pattern in ends if fnmatchcase(node, pattern)]
        if len(fits) == 1 and fits[0] not in there and fits[0] not in names.values():
            names[node] = fits[0]
    return renamed(claims, names)


def renamed(claims: Sequence[Claim], names: Mapping[str, str]) -> tuple[Claim, ...]:
    """Return claims as they were if nodes had other names: what is below a node's name goes with it."""
    return tuple(_renamed(one, names) for one in claims) if names else tuple(claims)


def _renamed(one: Claim, names: Mapping[str, str]) -> Claim:
    if one.node not in names:
        return one
    node = names[one.node]
    below = one.name.startswith(f"{one.node}/")
    return msgspec.structs.replace(one, node=node, name=node + one.name[len(one.node) :] if below else one.name)


def same_nodes(first: Sequence[Claim], second: Sequence[Claim]) -> dict[str, str]:
    """Return the name in ``first`` of nodes that only ``second`` has, where one that only ``first`` has is alike.

    Alike are two nodes of which each has more in common with the other than with any third: roles, names and types of
    endpoints, names of parameters. Two that are alike to the same degree are not distinguished, and neither is one.
    """
    here, there = _nodes(first), _nodes(second)
    lost = _parts(first, here - there)
    new = _parts(second, {name for name in there - here if not tool(name)})
    having: dict[_Part, list[str]] = {}
    for name, parts in lost.items():
        for part in parts:
            having.setdefault(part, []).append(name)
    # What many nodes have identifies none of them: pairs are those that share something else.
    telling = {part: names for part, names in having.items() if len(names) <= _MOST_ALIKE}
    pairs = {(one, other) for other, parts in new.items() for part in parts for one in telling.get(part, ())}
    likeness = {(one, other): share for one, other in pairs if (share := _likeness(lost[one], new[other])) >= ALIKE}
    best: dict[tuple[int, str], list[float]] = {}
    for pair, share in likeness.items():
        for side, name in enumerate(pair):
            best.setdefault((side, name), []).append(share)
    found: dict[str, str] = {}
    for (one, other), share in sorted(likeness.items()):
        # Itself is among them, once on each side.
        rivals = [value for value in (*best[0, one], *best[1, other]) if value >= share]
        if len(rivals) == len((one, other)):
            found[other] = one
    return found


def _nodes(claims: Sequence[Claim]) -> set[str]:
    return {one.node for one in claims if one.kind == NODE and one.resolved}


def _parts(claims: Sequence[Claim], nodes: Set[str]) -> dict[str, Counter[_Part]]:
    found: dict[str, Counter[_Part]] = {name: Counter() for name in sorted(nodes)}
    for one in claims:
        if one.node in found and one.kind != NODE and not plumbing(one):
            found[one.node][_part(one, one.node)] += 1
    return found


def _part(one: Claim, node: str) -> _Part:
    below = one.name.startswith(f"{node}/")
    name = f"~{one.name[len(node) :]}" if below else one.name
    return one.kind, name, "" if one.kind == PARAMETER else one.values.get("type", "")


def _likeness(one: Counter[_Part], other: Counter[_Part]) -> float:
    both, either = (one & other).total(), (one | other).total()
    return both / either if both >= _LEAST and either else 0.0


def same_ends(first: Sequence[Claim], second: Sequence[Claim]) -> dict[tuple[str, str, str], Claim]:
    """Return claims of ``first`` by the key of the endpoint of ``second`` that is the same under another name.

    Of a node, a role and a known type each side has exactly one endpoint that the other has not.
    """
    keys = {one.key for one in first}, {one.key for one in second}
    lost = _ends([one for one in first if one.key not in keys[1] and one.resolved])
    new = _ends([one for one in second if one.key not in keys[0] and one.resolved])
    return {
        others[0].key: ones[0]
        for group, others in new.items()
        if len(others) == 1 and len(ones := lost.get(group, [])) == 1
    }


def _ends(claims: Sequence[Claim]) -> dict[tuple[str, str, str], list[Claim]]:
    found: dict[tuple[str, str, str], list[Claim]] = {}
    for one in claims:
        type_ = one.values.get("type", "")
        if one.node and type_ and not plumbing(one):
            found.setdefault((one.node, one.kind, type_), []).append(one)
    return found
