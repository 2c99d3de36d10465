"""Rule ``graph.deadlock``: a callback waits for an answer that only its own callback group could take."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings, Wait

RULE = graph_rule(
    "graph.deadlock",
    "Deadlock of a service call",
    "A callback of a ROS 2 node calls a service and waits for the response, while the client is in the same mutually "
    "exclusive callback group as the callback (without an explicit group, both are in the default one). Give the "
    "client a group of its own and use a multi-threaded executor, or handle the response in a callback.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "services", "deadlock"),
    "The response arrives but is never processed, because its group is busy with the waiting callback: the node hangs.",
    url="https://docs.ros.org/en/rolling/How-To-Guides/Using-callback-groups.html",
)
_RECEIVING = frozenset({Role.SUBSCRIPTION, Role.SERVICE_SERVER, Role.ACTION_SERVER})
_REENTRANT = "Reentrant"


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each place of the code at which a callback waits for its own group."""
    if configuration.generation != "ros2":
        return
    waits = {(one.proof.path, one.proof.line): one for one in surroundings.waits}
    seen: set[tuple[str, int, str]] = set()
    for node in configuration.nodes:
        groups = _groups(node)
        for one in filter(_is_exclusive_client, node.endpoints):
            for site in one.sites:
                wait = waits.get((site.path, site.line))
                place = (site.path, site.line, one.endpoint.name)
                if wait is not None and place not in seen and one.group in groups.get(_plain(wait.function), ()):
                    seen.add(place)
                    yield _told(node, End(node, one), wait)


def _is_exclusive_client(one: ConfiguredEndpoint) -> bool:
    """Whether it is a client whose answer waits for the callbacks of its group."""
    return one.endpoint.role is Role.SERVICE_CLIENT and not one.group.startswith(_REENTRANT)


def _plain(function: str) -> str:
    return function.replace("::", ".")


def _groups(node: ConfiguredNode) -> dict[str, set[str]]:
    """Return the callback groups in which each function is called."""
    found_groups: dict[str, set[str]] = {}
    for one in node.endpoints:
        if one.endpoint.role in _RECEIVING and one.callback:
            found_groups.setdefault(_plain(one.callback), set()).add(one.group)
    for timer in node.timers:
        if timer.callback:
            found_groups.setdefault(_plain(timer.callback), set()).add(timer.group)
    return found_groups


def _told(node: ConfiguredNode, end: End, wait: Wait) -> Finding:
    certainty, doubt = weighed(RULE.certainty, (end.one.proof, wait.proof), end.conditions)
    group = f"group {end.one.group}" if end.one.group else "the default group"
    message = (
        f"{wait.function} of {node.name} waits ({wait.how}, {wait.proof.place}) for service {end.name}, whose client "
        f"({end.one.proof.place}) is in {group} as the callback itself: the answer is never taken. "
        "Give the client a callback group of its own."
    )
    return occurrence(
        RULE, message, wait.proof, entity=end.entity, certainty=certainty, context=wait.function, doubt=doubt
    )
