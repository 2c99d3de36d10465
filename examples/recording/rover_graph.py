"""Who was there on the drive that `record.py` writes, as a graph monitor publishes it on /rosgraph.

Five things are otherwise than the source of the rover says, as such things are on a robot that is used: the sonars are
read by a board whose program is not in the workspace, nobody started the robot_state_publisher, the follower was slowed
down by hand, an older build of the battery monitor publishes without keeping its last message, and at 15 s somebody took
over with a joystick that no launch file knows.
"""

from typing import Any

import numpy

from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

JOYSTICK_S = 15.0
DEFINITIONS = {
    "Graph": "Node[] nodes",
    "Node": """rcl_interfaces/ParameterDescriptor[] parameters
Topic[] publishers
Topic[] subscriptions
Service[] service_clients
Service[] service_servers
Action[] action_clients
Action[] action_servers
string name
rcl_interfaces/ParameterValue[] parameter_values""",
    "Topic": "string name\nInterfaceType type\nQoSProfile qos",
    "Service": "string name\nInterfaceType request_type\nInterfaceType response_type",
    "Action": "string name\nInterfaceType request_type\nInterfaceType response_type\nInterfaceType feedback_type",
    "InterfaceType": "string name\nTypeHash hash",
    "TypeHash": "uint8 version\nuint8[32] value",
    "QoSProfile": """uint32 depth
builtin_interfaces/Duration deadline
builtin_interfaces/Duration lifespan
uint8 history
uint8 reliability
uint8 durability
uint8 liveliness
builtin_interfaces/Duration liveliness_lease_duration""",
}
"""Of rosgraph_msgs, by the name of the message."""

SONARS = ("front", "left", "rear", "right")
RELIABLE, SENSOR, KEPT = (10, 1, 2), (5, 2, 2), (1, 1, 1)
"""Depth, reliability and durability by their numbers in QoSProfile."""


def store() -> Typestore:
    """Return the types of messages, with those of rosgraph_msgs."""
    found = get_typestore(Stores.ROS2_JAZZY)
    types = {}
    for name, text in DEFINITIONS.items():
        types.update(get_types_from_msg(text, f"rosgraph_msgs/msg/{name}"))
    found.register(types)
    return found


TYPES = store().types
Ends = tuple[tuple[str, str, tuple[int, int, int]], ...]


def made(name: str, *values: Any) -> Any:
    """Return a message of rosgraph_msgs."""
    return TYPES[f"rosgraph_msgs/msg/{name}"](*values)


def interface(name: str) -> Any:
    """Return a type whose hash nobody knows."""
    return made("InterfaceType", name, made("TypeHash", 0, numpy.zeros(32, dtype=numpy.uint8)))


def topics(ends: Ends) -> list[Any]:
    """Return ends of topics: name, type and profile."""
    never = TYPES["builtin_interfaces/msg/Duration"](0, 0)
    return [
        made(
            "Topic", name, interface(type_),
            made("QoSProfile", depth, never, never, 1, reliability, durability, 1, never),
        )
        for name, type_, (depth, reliability, durability) in ends
    ]  # fmt: skip


def parameter(name: str, value: object) -> tuple[Any, Any]:
    """Return a parameter as it is described and as it is set."""
    kinds = (bool, int, float, str)
    scalar = isinstance(value, kinds)
    kind = 9 if not scalar else kinds.index(type(value)) + 1
    empty = {key: numpy.zeros(0, dtype=key) for key in ("uint8", "bool", "int64", "float64")}
    described = TYPES["rcl_interfaces/msg/ParameterDescriptor"](name, kind, "", "", False, False, [], [])
    held = TYPES["rcl_interfaces/msg/ParameterValue"](
        kind, value is True, value if kind == 2 else 0, value if kind == 3 else 0.0, value if kind == 4 else "",
        empty["uint8"], empty["bool"], empty["int64"], empty["float64"], [] if scalar else list(value),
    )  # fmt: skip
    return described, held


def node(
    name: str, publishes: Ends = (), takes: Ends = (), parameters: dict[str, object] | None = None,
    services: tuple[tuple[str, str], ...] = (), actions: tuple[tuple[str, str], ...] = (),
) -> Any:  # fmt: skip
    """Return a node with its ends and the parameters that were set."""
    told = [parameter(*one) for one in (parameters or {}).items()]
    serves = [
        made("Service", one, interface(f"{type_}_Request"), interface(f"{type_}_Response")) for one, type_ in services
    ]
    acts = [
        made("Action", one, *(interface(f"{type_}_{part}") for part in ("Goal", "Result", "Feedback")))
        for one, type_ in actions
    ]
    return made(
        "Node", [one for one, _ in told], topics(publishes), topics(takes), [], serves, [], acts, name,
        [value for _, value in told],
    )  # fmt: skip


def graph(time: float) -> Any:
    """Return who is there at a second of the drive."""
    twist, status = "geometry_msgs/msg/Twist", "rover_msgs/msg/MotorStatus"
    scan, odometry, battery = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "sensor_msgs/msg/BatteryState"
    nodes = [
        node(
            "/battery_monitor", (("/battery", battery, RELIABLE),), (("/motor_status", status, RELIABLE),),
            {"stop_at": 0.1, "warn_at": 0.25},
        ),
        node(
            "/range_filter", (("/scan", scan, SENSOR),),
            tuple((f"/sonar/{side}", "sensor_msgs/msg/Range", SENSOR) for side in SONARS),
            {"longest_m": 4.0, "sonars": list(SONARS)},
        ),
        node(
            "/rover_base",
            (("/motor_status", status, RELIABLE), ("/odom", odometry, RELIABLE), ("/tf", "tf2_msgs/msg/TFMessage", (100, 1, 2))),
            (("/cmd_vel", twist, RELIABLE),),
            {"baud": 115200, "command_timeout_s": 0.5, "device": "/dev/ttyUSB0", "track_m": 0.42, "wheel_radius_m": 0.08},
        ),
        node(
            "/rover_follower",
            (("/cmd_vel", twist, RELIABLE), ("/rover_state", "rover_msgs/msg/RoverState", RELIABLE)),
            (
                ("/battery", battery, RELIABLE), ("/motor_status", status, RELIABLE), ("/odom", odometry, RELIABLE),
                ("/scan", scan, SENSOR),
            ),
            {
                "cruise_m_s": 0.5, "lookahead_m": 0.6, "max_angular_rad_s": 1.2, "max_linear_m_s": 0.4, "stop_at_m": 0.35,
                "turn_rad_s": 0.8,
            },
            (("/set_mission", "rover_msgs/srv/SetMission"),),
            (("/follow_mission", "rover_msgs/action/FollowMission"),),
        ),
    ]  # fmt: skip
    nodes.append(node("/sonar_board", tuple((f"/sonar/{side}", "sensor_msgs/msg/Range", SENSOR) for side in SONARS)))
    nodes.append(node("/rosgraph_monitor", (("/rosgraph", "rosgraph_msgs/msg/Graph", KEPT),)))
    if time >= JOYSTICK_S:
        nodes.append(node("/joystick", (("/cmd_vel", twist, RELIABLE),)))
    return made("Graph", nodes)
