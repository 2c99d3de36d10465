"""Rule ``graph.remap``: a remapping that matches nothing."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredRemap
from roslens.model.finding import Finding
from roslens.model.graphs.end import OTHER, End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import visible
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import ends, is_unknown, listed
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, ids_of, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.remap",
    "Remapping that matches nothing",
    "No node in the scope of a remapping uses the name that it remaps. Nodes whose code is unknown, or not completely "
    "analysed, are assumed to use it, except if a node outside the scope of a remapping for several nodes has the "
    "name: a remapping applies only to the actions after it in its group or file. It is a warning if somebody waits "
    "at the new name and one end of the node, of the same type, is connected to nothing, or if a similar name of a "
    "node was apparently meant, and a note if the remapping may be obsolete; names that every node has, such as /tf, "
    "are not reported. Correct the name, or move or remove the remapping.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "names", "launch"),
    "The node keeps its name, and the intended one remains unconnected; ROS does not report that a remapping had no "
    "effect.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each remapping that has no effect on any node."""
    usual = _in_use_elsewhere(configuration)
    held: dict[ConfiguredRemap, list[ConfiguredNode]] = {}
    effective: set[tuple[str, str, str]] = set()
    for node in configuration.nodes:
        for one in node.remaps:
            if one.used or one.uncertain or one.source == one.target or is_unknown(node):
                effective.add(_key(one))
            else:
                held.setdefault(one, []).append(node)
    for one, nodes in sorted(held.items(), key=lambda item: item[0]):
        if _key(one) not in effective and not surroundings.is_external(_absolute(one.source, nodes[0])):
            alone = (one.proof.path, one.source, one.target) not in usual
            waiting = _waiting(one, nodes, configuration)
            yield _told(one, nodes, [end.label for end in waiting], _free(waiting, nodes, configuration), alone=alone)
    yield from _out_of_reach(configuration)


def _out_of_reach(configuration: Configuration) -> Iterator[Finding]:
    """Yield remappings for several nodes of which none is known to use them, while a node outside of them does."""
    holders: dict[tuple[str, str, str], list[tuple[ConfiguredNode, ConfiguredRemap]]] = {}
    for node in configuration.nodes:
        for one in node.remaps:
            holders.setdefault(_key(one), []).append((node, one))
    for _place, held in sorted(holders.items(), key=lambda item: item[0]):
        inside = {node.name for node, _one in held}
        one = held[0][1]
        if len(inside) < 2 or any(each.used for _node, each in held) or not any(each.uncertain for _node, each in held):
            continue
        name = _absolute(one.source, held[0][0])
        users = [
            node
            for node in configuration.nodes
            if node.name not in inside and _uses(node, name) and not _has(node, one)
        ]
        if users and not any(_uses(node, name) for node, _one in held):
            yield _outside(one, held[0][0], len(inside), users)


def _absolute(name: str, node: ConfiguredNode) -> str:
    return name if name.startswith("/") else f"{node.name.rpartition('/')[0]}/{name}"


def _has(node: ConfiguredNode, one: ConfiguredRemap) -> bool:
    """Whether a node has a remapping of its own that does the same."""
    return any((other.source, other.target) == (one.source, one.target) for other in node.remaps)


def _uses(node: ConfiguredNode, name: str) -> bool:
    """Whether a node has a name, or names below it: the namespace of a node handle is remapped too."""
    return any(
        end.endpoint.name == name or end.endpoint.name.startswith(f"{name}/")
        for end in node.endpoints
        if not end.implicit
    )


def _outside(one: ConfiguredRemap, node: ConfiguredNode, count: int, users: list[ConfiguredNode]) -> Finding:
    certainty, doubt = weighed(
        RULE.certainty, (one.proof,), node.conditions, more="the code of some nodes that it applies to is unknown"
    )
    places = [f"{user.name} ({user.proof.place})" for user in users]
    who, verbs = listed(places), "does, and is" if len(set(places)) == 1 else "do, and are"
    message = (
        f"remapping of `{one.source}` to `{one.target}` applies to {count} nodes, none of which is known to use "
        f"the name. {who} {verbs} outside of it: a remapping applies to what follows it in its group or file. "
        "Move it in front of the node, or into it."
    )
    context = f"{one.source}:={one.target}"
    first, *also = ids_of(users)
    return occurrence(
        RULE, message, one.proof, entity=first, certainty=certainty, context=context, also=tuple(also), doubt=doubt
    )


def _key(one: ConfiguredRemap) -> tuple[str, str, str]:
    return one.proof.place, one.source, one.target


def _in_use_elsewhere(configuration: Configuration) -> set[tuple[str, str, str]]:
    """Return the remappings that have an effect on some node, by their file, which may give all the same."""
    return {(one.proof.path, one.source, one.target) for node in configuration.nodes for one in node.remaps if one.used}


def _waiting(one: ConfiguredRemap, nodes: list[ConfiguredNode], configuration: Configuration) -> list[End]:
    """Return the nodes that use the target of a remapping, where only one side does: the other one is missing."""
    held = {node.name for node in nodes}
    target = _absolute(one.target, nodes[0])
    users = [end for end in ends(configuration) if end.name == target and end.node.name not in held]
    return users if len({end.role for end in users}) == 1 else []


def _free(waiting: list[End], nodes: list[ConfiguredNode], configuration: Configuration) -> str:
    """Return the only name of these nodes that could be the other side of what waits, and that nobody else uses."""
    if not waiting or len({node.name for node in nodes}) > 1:
        return ""
    every = [end for end in ends(configuration) if end.node.name != nodes[0].name]
    fitting = {
        end.endpoint.name
        for end in nodes[0].endpoints
        if not end.implicit
        and end.endpoint.role is OTHER[waiting[0].role]
        and end.endpoint.type
        and {one.type for one in waiting} == {end.endpoint.type}
        and not any(other.name == end.endpoint.name for other in every)
    }
    return fitting.pop() if len(fitting) == 1 else ""


def _meant(source: str, names: list[str]) -> str:
    """Return the name that was likely meant: one that is nearly the same, or the same in another namespace."""
    near = nearest_name(source, names)
    last = source.rpartition("/")[2].lstrip("~")
    same = [name for name in names if name.rpartition("/")[2].lstrip("~") == last]
    return near or (min(same, key=lambda name: (len(name), name)) if same else "")


def _overtaken(one: ConfiguredRemap, nodes: list[ConfiguredNode]) -> ConfiguredRemap | None:
    """Return the remapping that takes the name before another one on every node; None where none does."""
    name = [_absolute(one.source, node) for node in nodes]
    found = [
        next((other for other in node.remaps if other.used and _absolute(other.source, node) == whole), None)
        for node, whole in zip(nodes, name, strict=True)
    ]
    return found[0] if None not in found else None


def _too_late(one: ConfiguredRemap, nodes: list[ConfiguredNode], first: ConfiguredRemap) -> Finding:
    certainty, doubt = weighed(RULE.certainty, (one.proof,), nodes[0].conditions)
    who = listed([node.name for node in nodes])
    message = (
        f"remapping of `{one.source}` to `{one.target}` has no effect on {who}: that to `{first.target}` "
        f"({first.proof.place}) is applied first. Remove one of the two."
    )
    context = f"{one.source}:={one.target}"
    entity, *also = ids_of(nodes)
    return occurrence(
        RULE, message, one.proof, entity=entity, certainty=certainty, context=context, also=tuple(also), doubt=doubt
    )


def _told(one: ConfiguredRemap, nodes: list[ConfiguredNode], waiting: list[str], free: str, *, alone: bool) -> Finding:
    overtaken = _overtaken(one, nodes)
    if overtaken is not None:
        return _too_late(one, nodes, overtaken)
    names = [end.given or end.endpoint.name for node in nodes for end in node.endpoints if not end.implicit]
    names += [end.endpoint.name for node in nodes for end in node.endpoints if not end.implicit]
    near = free or _meant(one.source, names)
    advice = f"Did you mean {visible(near)}?" if near else "Correct the name or remove the remapping."
    # Many are left over from a name that was changed, and do no harm: what was meant has to show.
    usual = RULE.certainty if alone and near else Certainty.HEURISTIC
    certainty, doubt = weighed(Certainty.LIKELY if free else usual, (one.proof,), nodes[0].conditions)
    if waiting:
        advice = f"{listed(waiting)} {'waits' if len(waiting) == 1 else 'wait'} for it at `{one.target}`. {advice}"
    who = listed([node.name for node in nodes])
    verb = "uses" if len(nodes) == 1 else "use"
    message = f"remapping of `{one.source}` to `{one.target}`: {who} {verb} no such name. {advice}"
    context = f"{one.source}:={one.target}"
    first, *also = ids_of(nodes)
    return occurrence(
        RULE, message, one.proof, entity=first, certainty=certainty, context=context, also=tuple(also), doubt=doubt
    )
