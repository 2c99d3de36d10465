"""Evidence of the role of a package in the computation graphs of a run: what its nodes exchange with others."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.graph import Role

_MEASURED = frozenset({"sensor_msgs"})
"""Packages of interfaces for what a device measures."""

_COMMANDS = frozenset(
    {
        "ackermann_msgs/AckermannDrive", "ackermann_msgs/AckermannDriveStamped", "geometry_msgs/Twist",
        "geometry_msgs/TwistStamped", "trajectory_msgs/JointTrajectory",
    }
)  # fmt: skip
"""Types by which a robot is commanded to move."""

_DONE = frozenset({"control_msgs", "move_base_msgs", "moveit_msgs", "nav2_msgs"})
"""Packages of interfaces for what a robot is asked to do."""


class Spoken(msgspec.Struct, frozen=True):
    """What the nodes of a package publish, take and ask for: types as ``package/Type``, each sorted."""

    published: tuple[str, ...] = ()
    taken: tuple[str, ...] = ()
    asked: tuple[str, ...] = ()


def spoken_by_package(configurations: Iterable[Configuration]) -> dict[str, Spoken]:
    """Return what is spoken by each package whose own nodes are in the graphs; what every node has does not count."""
    found: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for configuration in configurations:
        for node in configuration.nodes:
            if not node.package or node.role:
                continue
            for one in node.endpoints:
                field = _FIELDS.get(one.endpoint.role)
                if field and one.endpoint.type and not one.implicit:
                    found[node.package][field].add(plain(one.endpoint.type))
    return {
        package: Spoken(**{field: tuple(sorted(types)) for field, types in spoken.items()})
        for package, spoken in found.items()
    }


_FIELDS = {
    Role.PUBLISHER: "published",
    Role.SUBSCRIPTION: "taken",
    Role.ACTION_CLIENT: "asked",
    Role.SERVICE_CLIENT: "asked",
}


def plain(name: str) -> str:
    """Return a type as ``package/Type``, whichever generation wrote it."""
    package, _, rest = name.partition("/")
    return f"{package}/{rest.rpartition('/')[2]}"


def marks_of_graph(spoken: Spoken | None) -> Mapping[str, str]:
    """Return the marks that a package has by what its nodes speak, each with what shows it."""
    if spoken is None:
        return {}
    measures = [one for one in spoken.published if _of(one) in _MEASURED]
    uses = [one for one in spoken.taken if _of(one) in _MEASURED]
    commands = [one for one in spoken.published if one in _COMMANDS]
    obeys = [one for one in spoken.taken if one in _COMMANDS]
    asks = [one for one in spoken.asked if _of(one) in _DONE]
    found = {
        "graph_measures": f'its nodes publish "{measures[0]}" and receive nothing of the kind'
        if measures and not uses
        else "",
        "graph_obeys": f'its nodes are commanded to move by "{obeys[0]}" and command no others'
        if obeys and not commands
        else "",
        "graph_commands": f'its nodes command others to move by "{commands[0]}"' if commands and not obeys else "",
        "graph_asks": f'its nodes ask for "{asks[0]}"' if asks else "",
    }
    return {key: reason for key, reason in found.items() if reason}


def _of(name: str) -> str:
    return name.partition("/")[0]
