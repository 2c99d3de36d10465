"""Why no data arrives, reason by reason: what is asked, and how the system is that it is asked of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from cli.commands.test_why import every
from cli.commands.test_why_transform import STATIC, WHOLE
from cli.commands.test_why_transform import every as at

from pains.systems import (
    BEST_EFFORT,
    LIDAR,
    ODOM,
    PLANNER,
    RELIABLE,
    SCAN,
    TWIST,
    from_source,
    live,
    of_recording,
    of_transforms,
)
from roslens.compare.why.observed import Ended
from roslens.model.answers.ros_process import RosProcess
from roslens.model.graph import Endpoint, Instance, Node, Role


class Pain(NamedTuple):
    """A reason: its key in the page, the command that is asked, what is said, and words that must be in it."""

    key: str
    asks: str
    says: Callable[[Path], str]
    must: str


def _end(node: str, role: Role, name: str, kind: str, **more: object) -> Endpoint:
    return Endpoint(node, role, name, kind, **more)  # type: ignore[arg-type]


CLOCK = "rosgraph_msgs/msg/Clock"
PUB, SUB = Role.PUBLISHER, Role.SUBSCRIPTION
READS_CMD = _end("/odometry", SUB, "/cmd_vel", TWIST, qos=RELIABLE)
READS_ODOM = _end("/planner", SUB, "/odom", ODOM, qos=RELIABLE)
MAKES_ODOM = _end("/odometry", PUB, "/odom", ODOM, qos=RELIABLE)
READS_CLOCK = _end("/odometry", SUB, "/clock", CLOCK)
WANTS_ALL = _end("/planner", SUB, "/scan", SCAN, qos=RELIABLE)
LIDAR_PROGRAM = "/opt/robot/lib/demo_robot/lidar --ros-args -r __node:=lidar"


def _program(**more: object) -> RosProcess:
    return RosProcess(4711, LIDAR_PROGRAM, 1000, **more)  # type: ignore[arg-type]


PAINS = (
    Pain("name", "roslens why /cmd_vel --live",
         lambda folder: live(folder, "/cmd_vel", (READS_CMD, _end("/planner", PUB, "/cmd_vle", TWIST, qos=RELIABLE))),
         "publishes /cmd_vle instead"),
    Pain("namespace", "roslens why /robot1/scan --live --no-source",
         lambda folder: live(folder, "/robot1/scan", (LIDAR, _end("/robot1/planner", SUB, "/robot1/scan", SCAN)),
                             source=False),
         "/lidar publishes /scan, which nobody else uses"),
    Pain("remapping", "roslens why /cmd_vel --arg cmd_vel:=cmd_vle",
         lambda folder: from_source(folder, "broken", "/cmd_vel", "--arg", "cmd_vel:=cmd_vle"),
         "is remapped from /cmd_vel to"),
    Pain("argument", "roslens why /cmd_vel --launch rover --arg navigation:=false",
         lambda folder: from_source(folder, "workspace", "/cmd_vel", "--launch", "rover", "--arg", "navigation:=false"),
         "navigation:=true"),
    Pain("not_running", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (PLANNER,)), "/lidar, which should make it, does not run"),
    Pain("crashed", "roslens why /scan --live --for 60s",
         lambda folder: live(folder, "/scan", (PLANNER,), ended=(
             Ended("/lidar", "was ended by signal 11 (SIGSEGV)", ("[ERROR] [lidar]: no answer of /dev/ttyUSB0",)),)),
         "signal 11"),
    Pain("lifecycle", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (LIDAR, PLANNER), nodes=(Node("/lidar", lifecycle="inactive"),)),
         "/lidar is inactive"),
    Pain("twins", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (LIDAR, PLANNER), nodes=(
             Node("/lidar", instances=(Instance("robot", 300), Instance("robot", 412))),)),
         "2 nodes are called /lidar"),
    Pain("simulated_time", "roslens why /odom --live",
         lambda folder: live(folder, "/odom", (MAKES_ODOM, READS_ODOM, READS_CLOCK)),
         "nobody publishes /clock"),
    Pain("domain", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (PLANNER,), processes=(_program(domain="7"),)),
         "ROS_DOMAIN_ID is 7"),
    Pain("discovery", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (PLANNER,), processes=(_program(discovery="OFF"),)),
         "ROS_AUTOMATIC_DISCOVERY_RANGE is OFF"),
    Pain("middleware", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (PLANNER,), processes=(_program(rmw="rmw_cyclonedds_cpp"),),
                             here={"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}),
         "RMW_IMPLEMENTATION is rmw_cyclonedds_cpp"),
    Pain("zenoh", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (PLANNER,), processes=(_program(rmw="rmw_zenoh_cpp"),),
                             here={"RMW_IMPLEMENTATION": "rmw_zenoh_cpp"}),
         "no router of Zenoh"),
    Pain("users", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (LIDAR, PLANNER), processes=(
             RosProcess(100, LIDAR_PROGRAM, 1000), RosProcess(101, "/opt/robot/lib/demo_robot/planner", 1001)),
             closed_memory=frozenset({1000})),
         "it runs as user 1001, and /lidar as 1000"),
    Pain("type", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (
             LIDAR, _end("/planner", SUB, "/scan", "sensor_msgs/msg/PointCloud2", qos=BEST_EFFORT))),
         "its ends have 2 types"),
    Pain("type_version", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (
             _end("/lidar", PUB, "/scan", "robot_msgs/msg/Scan", hash="RIHS01_1f2e", qos=BEST_EFFORT),
             _end("/planner", SUB, "/scan", "robot_msgs/msg/Scan", hash="RIHS01_77ab", qos=BEST_EFFORT)), source=False),
         "2 versions of robot_msgs/msg/Scan"),
    Pain("qos", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (LIDAR, WANTS_ALL)), "reliable is requested, best_effort offered"),
    Pain("qos_source", "roslens why /scan",
         lambda folder: from_source(folder, "workspace", "/scan", change=True),
         "reliable is requested, best_effort offered"),
    Pain("silent", "roslens why /scan --live --tap /scan",
         lambda folder: live(folder, "/scan", (LIDAR, PLANNER), values={"topic:/scan": {"rate": 0.0}}),
         "no message came in 2.0 s"),
    Pain("loss", "roslens why /scan --live",
         lambda folder: live(folder, "/scan", (LIDAR, PLANNER), values={"topic:/scan": {"rate": 10.0, "loss": 38.0}}),
         "38.0 % of the messages did not arrive"),
    Pain("stopped", "roslens why /imu --launch rover --bag drive",
         lambda folder: of_recording(folder, "/imu", {"/imu": every(0.1, 30), "/odom": every(0.05, 60)}),
         "it stopped"),
    Pain("two_trees", "roslens why 'map->laser' --bag drive",
         lambda folder: of_transforms(folder, "map->laser", WHOLE[1:], (("base_link", "laser"), ("map", "dock"))),
         "are in two trees"),
    Pain("no_frame", "roslens why 'map->laser_link' --bag drive",
         lambda folder: of_transforms(folder, "map->laser_link", WHOLE, STATIC), "is no frame that was said"),
    Pain("transform_stopped", "roslens why 'map->base_link' --bag drive",
         lambda folder: of_transforms(folder, "map->base_link", [("map", "odom", at(10, 8), 0.05), WHOLE[1]]),
         "map → odom stopped"),
    Pain("two_parents", "roslens why 'map->base_link' --bag drive",
         lambda folder: of_transforms(folder, "map->base_link", [*WHOLE, ("map", "base_link", at(10, 20), 0.01)]),
         "base_link has 2 parents"),
    Pain("future", "roslens why 'map->base_link' --bag drive",
         lambda folder: of_transforms(folder, "map->base_link", [WHOLE[0], ("odom", "base_link", at(50, 20), -3.0)]),
         "in the future"),
)  # fmt: skip
