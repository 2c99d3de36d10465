"""Configurations made up by hand (a robot) and by rule (large ones), for tests of the computation graph's pages."""

from __future__ import annotations

import random

from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    ConfiguredRemap,
    ConfiguredTimer,
    Origin,
    Proof,
    Unresolved,
)
from roslens.model.finding import Finding, Severity
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos

LAUNCH = "src/rover_bringup/launch/rover.launch.py"
SENSOR = Qos("best_effort", "volatile", "keep_last", 5)
RELIABLE = Qos("reliable", "volatile", "keep_last", 10)
LATCHED = Qos("reliable", "transient_local", "keep_last", 1)


def end(
    node: str,
    role: Role,
    name: str,
    type_: str,
    line: int,
    *,
    qos: Qos | None = RELIABLE,
    sure: str = "certain",
    origin: Origin = Origin.CODE,
    resolved: bool = True,
    conditions: tuple[str, ...] = (),
    callback: str = "",
    remapped: Proof | None = None,
) -> ConfiguredEndpoint:
    """Return an endpoint that is made in a line of its node's source."""
    source = f"src/rover/{node.rpartition('/')[2]}.cpp"
    return ConfiguredEndpoint(
        Endpoint(node, role, name, type_, "RIHS01_" + "ab" * 8 if type_ else "", qos),
        Proof(source, line, 5, "a literal", sure, origin),
        given=name,
        resolved=resolved,
        conditions=conditions,
        callback=callback,
        remapped=remapped,
    )


def quiet_ends(node: str) -> list[ConfiguredEndpoint]:
    """Return what every node of ROS 2 has."""
    services = ("describe_parameters", "get_parameters", "list_parameters", "set_parameters")
    return [
        end(node, Role.PUBLISHER, "/rosout", "rcl_interfaces/msg/Log", 0, origin=Origin.IMPLICIT),
        end(node, Role.PUBLISHER, "/parameter_events", "rcl_interfaces/msg/ParameterEvent", 0, origin=Origin.IMPLICIT),
        *(
            end(node, Role.SERVICE_SERVER, f"{node}/{name}", "rcl_interfaces/srv/X", 0, origin=Origin.IMPLICIT)
            for name in services
        ),
    ]


def node(name: str, line: int, *ends: ConfiguredEndpoint, **more: object) -> ConfiguredNode:
    """Return a node that the launch file starts."""
    return ConfiguredNode(
        name,
        Proof(LAUNCH, line, 9, "Node()", origin=Origin.LAUNCH),
        package="rover",
        executable=name.rpartition("/")[2],
        defined=Proof(f"src/rover/{name.rpartition('/')[2]}.cpp", 12),
        unit="rover::Node",
        endpoints=tuple(
            sorted((*ends, *quiet_ends(name)), key=lambda one: (one.endpoint.role.value, one.endpoint.name))
        ),
        **more,  # type: ignore[arg-type]
    )


def robot() -> Configuration:
    """Return a rover with a lidar, two cameras in namespaces, a planner, and what is only there sometimes."""
    pub, sub = Role.PUBLISHER, Role.SUBSCRIPTION
    server, client = Role.SERVICE_SERVER, Role.SERVICE_CLIENT
    image, scan, odom, twist = (
        "sensor_msgs/msg/Image",
        "sensor_msgs/msg/LaserScan",
        "nav_msgs/msg/Odometry",
        "geometry_msgs/msg/Twist",
    )
    tf = "tf2_msgs/msg/TFMessage"
    navigate = "nav2_msgs/action/NavigateToPose"
    cameras = [
        node(
            f"/{side}/camera",
            20 + place,
            end(f"/{side}/camera", pub, f"/{side}/image_raw", image, 31, qos=SENSOR),
            end(f"/{side}/camera", pub, f"/{side}/camera_info", "sensor_msgs/msg/CameraInfo", 33, qos=SENSOR),
            kind="component",
            container="/container",
        )
        for place, side in enumerate(("left", "right"))
    ]
    planner = "/navigation/planner"
    return Configuration(
        title="rover_bringup/rover.launch.py camera:=true",
        generation="ros2",
        nodes=tuple(
            sorted(
                (
                    *cameras,
                    node("/container", 18, kind="container"),
                    node("/lidar", 30, end("/lidar", pub, "/scan", scan, 44, qos=SENSOR)),
                    node(
                        "/odometry",
                        34,
                        end("/odometry", pub, "/odom", odom, 51),
                        end("/odometry", pub, "/tf", tf, 52),
                        end(
                            "/odometry", server, "/odometry/reset", "std_srvs/srv/Empty", 53, callback="Odometry::reset"
                        ),
                        end("/odometry", sub, "/cmd_vel", twist, 55, callback="Odometry::on_command"),
                        timers=(ConfiguredTimer(0.02, Proof("src/rover/odometry.cpp", 57), "Odometry::tick"),),
                    ),
                    node(
                        planner,
                        40,
                        end(planner, sub, "/scan", scan, 61, qos=RELIABLE, callback="Planner::on_scan"),
                        end(planner, sub, "/odom", odom, 62, callback="Planner::on_odometry"),
                        end(planner, sub, "/tf", tf, 63),
                        end(
                            planner,
                            pub,
                            "/cmd_vel",
                            twist,
                            64,
                            remapped=Proof(LAUNCH, 43, origin=Origin.LAUNCH),
                        ),
                        end(planner, pub, "/navigation/plan", "nav_msgs/msg/Path", 65, qos=LATCHED),
                        end(
                            planner,
                            pub,
                            "/navigation/debug/costs",
                            "nav_msgs/msg/OccupancyGrid",
                            66,
                            conditions=("debug_",),
                        ),
                        end(
                            planner,
                            Role.ACTION_SERVER,
                            "/navigation/navigate",
                            navigate,
                            68,
                            callback="Planner::execute",
                        ),
                        end(planner, client, "/odometry/reset", "std_srvs/srv/Empty", 70, sure="likely"),
                        kind="lifecycle",
                        parameters=(
                            ConfiguredParameter(
                                "max_speed",
                                "0.8",
                                "double",
                                "1.0",
                                "[0.0, 2.0]",
                                "declared",
                                Proof("src/rover/planner.cpp", 21),
                                "double",
                                Proof("src/rover_bringup/config/rover.yaml", 4, origin=Origin.LAUNCH),
                            ),
                            ConfiguredParameter(
                                "debug", None, "bool", "false", "", "declared", Proof("src/rover/planner.cpp", 22)
                            ),
                        ),
                        remaps=(ConfiguredRemap("cmd", "/cmd_vel", Proof(LAUNCH, 43), used=True),),
                    ),
                    node(
                        "/navigation/detector",
                        46,
                        end(
                            "/navigation/detector",
                            sub,
                            "/left/image_raw",
                            image,
                            15,
                            qos=SENSOR,
                            callback="Detector::left",
                        ),
                        end(
                            "/navigation/detector",
                            sub,
                            "/right/image_raw",
                            image,
                            16,
                            qos=SENSOR,
                            callback="Detector::right",
                        ),
                        end(
                            "/navigation/detector",
                            pub,
                            "/navigation/*/objects",
                            "vision_msgs/msg/Detection2DArray",
                            18,
                            resolved=False,
                            sure="possible",
                        ),
                        conditions=('camera == "true"',),
                    ),
                    node(
                        "/mission",
                        52,
                        end("/mission", Role.ACTION_CLIENT, "/navigation/navigate", navigate, 11),
                        end("/mission", sub, "/navigation/plan", "nav_msgs/msg/Path", 12, qos=LATCHED),
                        end("/mission", pub, "/status", "", 14, sure="likely"),
                    ),
                ),
                key=lambda one: one.name,
            )
        ),
        included=("src/rover_bringup/launch/cameras.launch.py",),
        unresolved=(
            Unresolved(
                "'/' + model + '/objects'",
                Proof("src/rover/detector.cpp", 18),
                "a value that is read at run time",
                "/navigation/detector",
            ),
        ),
    )


def robot_findings() -> tuple[Finding, ...]:
    """Return what is wrong with the robot."""
    return (
        Finding(
            "graph.qos",
            Severity.ERROR,
            "the planner asks for `reliable`, the lidar offers `best_effort`: nothing arrives",
            "src/rover/planner.cpp",
            61,
            entity="topic:/scan",
        ),
        Finding("graph.one_end", Severity.WARNING, "nobody subscribes", LAUNCH, 52, entity="topic:/status"),
        Finding("graph.clock", Severity.NOTE, "`use_sim_time` is not set", LAUNCH, 52, entity="node:/mission"),
    )


def large(nodes: int = 80, topics: int = 300, seed: int = 5) -> Configuration:
    """Return a system by chance: most things flow one way, a few topics have many ends."""
    chance = random.Random(seed)
    spaces = ("", "/front", "/rear", "/navigation", "/navigation/local", "/navigation/global", "/arm", "/perception")
    names = [f"{spaces[number % len(spaces)]}/node_{number:02d}" for number in range(nodes)]
    ends: dict[str, list[ConfiguredEndpoint]] = {name: [] for name in names}
    for topic in range(topics):
        giver = chance.randrange(nodes)
        name = (
            f"{names[giver].rpartition('/')[0]}/topic_{topic:03d}_{chance.choice(('image', 'state', 'cmd', 'points'))}"
        )
        ends[names[giver]].append(end(names[giver], Role.PUBLISHER, name, "std_msgs/msg/String", 10 + topic))
        takers = chance.choice((0, 1, 1, 1, 1, 2, 2, 3))
        for _ in range(takers):
            ahead = (
                giver + chance.choice((1, 2, 3, 8, 8, 8, 16, 24, -8))
                if chance.random() < 0.85
                else chance.randrange(nodes)
            )
            taker = names[ahead % nodes]
            ends[taker].append(
                end(taker, Role.SUBSCRIPTION, name, "std_msgs/msg/String", 400 + topic, callback=f"on_{topic}")
            )
    made = [node(name, 10 + number, *ends[name]) for number, name in enumerate(names)]
    return Configuration("large", "ros2", tuple(sorted(made, key=lambda one: one.name)))
