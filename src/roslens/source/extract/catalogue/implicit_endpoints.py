"""Endpoints that every node has, whatever its code says: of logging, parameters, time, life cycle and composition.

ROS 2: rclcpp and rclpy of Humble to Lyrical; ROS 1: roscpp and rospy of Noetic. What only nodes of
one release or client library have is likely, not certain.
"""

from __future__ import annotations

from roslens.model.configuration import ConfiguredEndpoint, Origin, Proof
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos

_EVENTS = Qos("reliable", "volatile", "keep_last", 1000)
_LOG = Qos("reliable", "transient_local", "keep_last", 1000, lifespan_s=10.0)
_CLOCK = Qos("best_effort", "volatile", "keep_last", 1)
_TRANSITIONS = Qos("reliable", "volatile", "keep_last", 1)
_PARAMETERS = (
    "DescribeParameters",
    "GetParameters",
    "GetParameterTypes",
    "ListParameters",
    "SetParameters",
    "SetParametersAtomically",
)
_LIFECYCLE = (
    ("change_state", "ChangeState"),
    ("get_available_states", "GetAvailableStates"),
    ("get_available_transitions", "GetAvailableTransitions"),
    ("get_state", "GetState"),
    ("get_transition_graph", "GetAvailableTransitions"),
)
_CONTAINER = (("list_nodes", "ListNodes"), ("load_node", "LoadNode"), ("unload_node", "UnloadNode"))
_MANAGER = (("list", "NodeletList"), ("load_nodelet", "NodeletLoad"), ("unload_nodelet", "NodeletUnload"))


def _container(found: _Found) -> None:
    for name, kind_of in _CONTAINER:
        found.add(Role.SERVICE_SERVER, f"~/_container/{name}", f"composition_interfaces/srv/{kind_of}")


def _managed(found: _Found) -> None:
    found.add(Role.PUBLISHER, "~/transition_event", "lifecycle_msgs/msg/TransitionEvent", _TRANSITIONS)
    for name, kind_of in _LIFECYCLE:
        found.add(Role.SERVICE_SERVER, f"~/{name}", f"lifecycle_msgs/srv/{kind_of}")


def implicit_endpoints(
    node: str, generation: str, kind: str, *, sim_time: bool, lifecycle: bool, cpp: bool | None, process: bool = True
) -> list[ConfiguredEndpoint]:
    """Return the endpoints that a node has besides those of its code.

    Args:
        node: its resolved name.
        generation: ``ros1`` or ``ros2``.
        kind: ``node``, ``container``, ``component``, ``nodelet`` …
        sim_time: whether it takes its time from ``/clock``.
        lifecycle: whether it is managed.
        cpp: whether it is written in C++; None where that is unknown.
        process: whether it is a nodelet whose name is that of a process too, see :func:`is_process`.
    """
    found = _Found(node)
    if generation == "ros1" and kind == "nodelet" and not process:
        return found.endpoints
    if generation == "ros1":
        _ros1(found, kind)
    else:
        _ros2(found, cpp)
        if lifecycle:
            _managed(found)
        if kind == "container":
            _container(found)
    if sim_time:
        package = "rosgraph_msgs/msg/Clock" if generation == "ros2" else "rosgraph_msgs/Clock"
        found.add(Role.SUBSCRIPTION, "/clock", package, _CLOCK if generation == "ros2" else None, how="use_sim_time")
    return found.endpoints


class _Found:
    def __init__(self, node: str) -> None:
        self.node = node
        self.endpoints: list[ConfiguredEndpoint] = []

    def add(
        self, role: Role, name: str, kind: str, qos: Qos | None = None, *, sure: str = "certain", how: str = ""
    ) -> None:
        resolved = self.node.rstrip("/") + name[1:] if name.startswith("~") else name
        proof = Proof(how=how or "every node of its kind has it", sure=sure, origin=Origin.IMPLICIT)
        self.endpoints.append(
            ConfiguredEndpoint(Endpoint(self.node, role, resolved, kind, qos=qos), proof, name, "*" not in resolved)
        )


def _ros1(found: _Found, kind: str) -> None:
    found.add(Role.PUBLISHER, "/rosout", "rosgraph_msgs/Log")
    found.add(Role.SERVICE_SERVER, "~/get_loggers", "roscpp/GetLoggers")
    found.add(Role.SERVICE_SERVER, "~/set_logger_level", "roscpp/SetLoggerLevel")
    if kind == "container":
        for name, kind_of in _MANAGER:
            found.add(Role.SERVICE_SERVER, f"~/{name}", f"nodelet/{kind_of}")


def _ros2(found: _Found, cpp: bool | None) -> None:
    found.add(Role.PUBLISHER, "/rosout", "rcl_interfaces/msg/Log", _LOG)
    found.add(Role.PUBLISHER, "/parameter_events", "rcl_interfaces/msg/ParameterEvent", _EVENTS)
    if cpp is not False:
        # Its source of time listens whether use_sim_time changes; newer releases ask the node itself.
        found.add(
            Role.SUBSCRIPTION, "/parameter_events", "rcl_interfaces/msg/ParameterEvent", _EVENTS, sure="likely",
            how="nodes in C++ have it, until Jazzy",
        )  # fmt: skip
    for name in _PARAMETERS:
        snake = "".join(f"_{sign.lower()}" if sign.isupper() else sign for sign in name).lstrip("_")
        found.add(Role.SERVICE_SERVER, f"~/{snake}", f"rcl_interfaces/srv/{name}")
    found.add(
        Role.SERVICE_SERVER, "~/get_type_description", "type_description_interfaces/srv/GetTypeDescription",
        sure="likely", how="nodes have it since Jazzy",
    )  # fmt: skip
