"""Rule ``graph.node_name``: two nodes of one name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations

from roslens.model.configuration import Configuration, ConfiguredNode, Origin
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.brief import is_brief
from roslens.source.rules.graph.doubt import exclude_each_other, weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.node_name",
    "Two nodes with the same name",
    "Two nodes that run together have the same resolved name. Nodes with a random suffix in their name, nodes whose "
    "name is set only by code and unknown, and alternatives of which opposite conditions start only one are not "
    "reported; ROS 2 programs that exit after completing their task, such as spawners, are a note. So are two nodes "
    "of one program of ROS 2 that the name given in a launch file renames both. Give each node its own name or "
    "namespace.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "names", "launch"),
    "roslaunch refuses a launch that has two, and starts none of its nodes; elsewhere ROS 1 shuts down the first one "
    "when the second starts. In ROS 2 both run, but their services, parameters and life cycles cannot be "
    "distinguished.",
)


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name that several nodes have."""
    by_name: dict[str, list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        if node.resolved and not node.anonymous and not node.name_is_guessed and node.kind not in ("process", "test"):
            by_name.setdefault(node.name, []).append(node)
    ros1 = configuration.generation == "ros1"
    for name, nodes in sorted(by_name.items()):
        pairs = [pair for pair in combinations(nodes, 2) if _collide(*pair, nodes)]
        if pairs:
            first, second = min(pairs, key=lambda pair: len(pair[0].conditions) + len(pair[1].conditions))
            yield _told(name, first, second, len(nodes), configuration)
        elif not ros1 and (renamed := _renamed(nodes)):
            yield _told_of_one(name, renamed)


def _collide(first: ConfiguredNode, second: ConfiguredNode, nodes: list[ConfiguredNode]) -> bool:
    # One program may make several nodes, all of which a name given at its start renames: that is one process. It is
    # started twice where all of its units are there twice.
    if first.proof.place == second.proof.place:
        units = Counter((node.unit, node.defined) for node in nodes if node.proof.place == first.proof.place)
        if (first.unit, first.defined) != (second.unit, second.defined) or min(units.values()) < 2:
            return False
    return not exclude_each_other(first.clauses, second.clauses)


def _renamed(nodes: list[ConfiguredNode]) -> tuple[ConfiguredNode, ConfiguredNode] | None:
    """Return two nodes of one process that the name given at its start makes one of."""
    for first, second in combinations(nodes, 2):
        if (
            first.proof.place == second.proof.place
            and first.proof.origin is Origin.LAUNCH
            and first.defined != second.defined
            and None not in (first.defined, second.defined)
            and not (first.container or second.container)
            and not exclude_each_other(first.clauses, second.clauses)
        ):
            return first, second
    return None


def _told_of_one(name: str, pair: tuple[ConfiguredNode, ConfiguredNode]) -> Finding:
    first, second = pair
    certainty, doubt = weighed(
        Certainty.LIKELY, (first.proof, first.defined, second.defined), (*first.conditions, *second.conditions)
    )
    made = " and ".join(one.defined.place for one in pair if one.defined is not None)
    message = (
        f"{_what(first)} makes two nodes ({made}), and the name given here renames both to {name}: they cannot be "
        "distinguished. Leave the name away, or give it to one of them (`NODE:__node:=NAME` in ros_arguments)."
    )
    return occurrence(RULE, message, first.proof, entity=f"node:{name}", certainty=certainty, doubt=doubt)


def _told(
    name: str, first: ConfiguredNode, second: ConfiguredNode, count: int, configuration: Configuration
) -> Finding:
    ros1 = configuration.generation == "ros1"
    is_refused = ros1 and {first.proof.origin, second.proof.origin} == {Origin.LAUNCH}
    certainty, doubt = weighed(
        RULE.certainty if ros1 else Certainty.HEURISTIC if is_brief(first) and is_brief(second) else Certainty.LIKELY,
        (first.proof, second.proof),
        (*first.conditions, *second.conditions),
    )
    effect = "the first is shut down when the second starts" if ros1 else "they cannot be distinguished"
    if is_refused:
        effect = f"roslaunch refuses {configuration.title} and starts nothing of it"
    more = f" {count} nodes have this name." if count > 2 else ""
    message = (
        f"{_what(first)} ({first.proof.place}) and {_what(second)} ({second.proof.place}) are both called {name}: "
        f"{effect}.{more} Give one of them another name or namespace."
    )
    return occurrence(
        RULE, message, second.proof, entity=f"node:{name}", certainty=certainty, doubt=doubt,
        consequence=Consequence.STOPS_START if is_refused else None,
    )  # fmt: skip


def _what(node: ConfiguredNode) -> str:
    return "/".join(part for part in (node.package, node.executable) if part) or "a node"
