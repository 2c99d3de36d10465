"""Rule ``graph.stamped_command``: commands without a stamp, where a controller of ros2_control takes stamped ones."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from roslens.model.configuration import Configuration, ConfiguredNode, Origin, Proof
from roslens.model.errors import DocumentError
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.parameters.parameter_file import ros2_parameters
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import ends
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Commanded, Surroundings

Content = Callable[[str], bytes | None]

_PLAIN = "geometry_msgs/msg/Twist"
_TOPICS = {
    "diff_drive_controller/DiffDriveController": "cmd_vel",
    "omni_wheel_drive_controller/OmniWheelDriveController": "cmd_vel",
    "mecanum_drive_controller/MecanumDriveController": "reference",
    "ackermann_steering_controller/AckermannSteeringController": "reference",
    "bicycle_steering_controller/BicycleSteeringController": "reference",
    "tricycle_steering_controller/TricycleSteeringController": "reference",
}
"""By type of controller, the topic on which it takes TwistStamped, whatever its parameters, in Humble, Jazzy and
Lyrical (ros-controls/ros2_controllers). Commands without a stamp have another topic in Humble, and none later."""
_MANAGER = "controller_manager"
_STAMPS = {
    "teleop_twist_keyboard": "stamped",
    "teleop_twist_joy": "publish_stamped_twist",
    "twist_mux": "use_stamped",
    "nav2_controller": "enable_stamped_cmd_vel",
    "nav2_behaviors": "enable_stamped_cmd_vel",
}
"""By package, the parameter with which a node sends stamped commands."""
_LATER_ON = frozenset({"enable_stamped_cmd_vel", "use_stamped"})
"""Parameters that are true where they are not set, in later releases: Nav2 from Kilted on, twist_mux 4.5.0."""

RULE = graph_rule(
    "graph.stamped_command",
    "Commands without a stamp for a controller",
    "A node publishes geometry_msgs/Twist on the topic of a controller of ros2_control that takes TwistStamped there: "
    "diff_drive_controller, omni_wheel_drive_controller, mecanum_drive_controller and those of steering. Publish "
    "TwistStamped, or set the parameter of the node that does (`stamped` of teleop_twist_keyboard, "
    "`publish_stamped_twist` of teleop_twist_joy, `use_stamped` of twist_mux, `enable_stamped_cmd_vel` of Nav2). "
    "Controllers are those of the parameter files of the workspace.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "type", "connectivity"),
    "Ends of different types are never connected: the robot does not move, and nothing says so.",
    url="https://control.ros.org/jazzy/doc/ros2_controllers/doc/migration.html",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each publisher whose commands a controller cannot receive."""
    moved = _moved(configuration.nodes)
    for end in ends(configuration):
        if end.role is not Role.PUBLISHER or end.type != _PLAIN or not _is_decided(end.node):
            continue
        for one in surroundings.controllers:
            if end.name in (f"/{one.name}/{one.topic}", moved.get(f"/{one.name}/{one.topic}")):
                yield _told(end, one)
                break


def controllers(configuration: Configuration, paths: Iterable[str], content: Content) -> Iterator[Commanded]:
    """Yield the controllers that take stamped commands, where anything of a configuration publishes others.

    Args:
        configuration: what would run together.
        paths: of all files of the workspace.
        content: of a file; None where it cannot be read.
    """
    if configuration.generation != "ros2":
        return
    if not any(end.role is Role.PUBLISHER and end.type == _PLAIN for end in ends(configuration)):
        return
    for path in paths:
        text = content(path) if path.endswith((".yaml", ".yml")) else None
        if text and b"ros__parameters" in text and any(one.encode() in text for one in _TOPICS):
            yield from _commanded(text, path)


def _commanded(text: bytes, path: str) -> Iterator[Commanded]:
    try:
        settings = ros2_parameters(text, path)
    except DocumentError:
        return  # Why it cannot be read is a finding of the launch file that gives it to a node.
    for one in settings:
        name, _, last = str(one.name).rpartition(".")
        kind = str(one.value)
        if last == "type" and kind in _TOPICS and one.node.rpartition("/")[2] == _MANAGER:
            yield Commanded(name, kind, _TOPICS[kind], Proof(path, one.evidence.line))


def _moved(nodes: Iterable[ConfiguredNode]) -> dict[str, str]:
    """Return what remappings of the node with the manager call the topics of controllers: they count for these too."""
    return {
        re.sub(r"^(?!/)", "/", one.source): one.target
        for node in nodes
        if node.package == _MANAGER
        for one in node.remaps
        if not one.uncertain
    }


def _is_decided(node: ConfiguredNode) -> bool:
    """Return whether a node certainly sends what it is known to: later releases of some send stamped commands."""
    stamps = _STAMPS.get(node.package)
    return stamps not in _LATER_ON or any(one.name == stamps for one in node.parameters if one.set_by)


def _told(end: End, one: Commanded) -> Finding:
    parameter = _STAMPS.get(end.node.package, "")
    meant = f"set its parameter `{parameter}` to true" if parameter else "publish TwistStamped"
    message = (
        f"{end.node.name} publishes {end.name} as {_PLAIN}, and controller '{one.name}' ({one.type}, "
        f"{one.proof.place}) takes geometry_msgs/msg/TwistStamped there: they are never connected. Expected stamped "
        f"commands: {meant}."
    )
    proof = end.one.proof if end.one.proof.origin is Origin.CODE else end.node.proof
    certainty, doubt = weighed(RULE.certainty, (proof,), end.conditions)
    return occurrence(RULE, message, proof, entity=end.entity, certainty=certainty, context=end.node.name, doubt=doubt)
