"""Roles: each decision with its reasons, and how well they hold for repositories that weights do not know."""

import csv
import importlib.util
import sys
from pathlib import Path

import msgspec
import pytest

from roslens.model.result import RoleInclude
from roslens.model.source import Dependency, Language, Location, Package, Role, SourceFile
from roslens.source.study.role import KINDS, ROLES, decide, weights
from roslens.source.study.role_graph import Spoken
from roslens.source.study.role_marks import RoleFacts, marks_of, words

BENCHMARK = Path(__file__).parents[3] / "benchmarks" / "roles.py"


@pytest.fixture(scope="module")
def benchmark():
    spec = importlib.util.spec_from_file_location("roles_benchmark", BENCHMARK)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def facts(name, files=("src/node.cpp",), needs=("roscpp",), description="", repository="repo", nodes=True, **more):
    languages = {".cpp": Language.CPP, ".hpp": Language.CPP, ".py": Language.PYTHON, ".launch": Language.LAUNCH_XML,
                 ".msg": Language.MSG, ".xacro": Language.XACRO, ".xml": Language.XML}  # fmt: skip
    found = tuple(SourceFile(path, languages["." + path.rpartition(".")[2]]) for path in files)
    where = Location("package.xml")
    depends = tuple(Dependency(one, "depend", where) for one in needs)
    package = Package(name, name, ".", where, description=description, dependencies=depends, **more)
    return RoleFacts(package, found, repository, nodes)


@pytest.mark.parametrize(
    ("given", "role", "reason"),
    [
        (facts("kobuki_driver"), "driver", 'made for "kobuki", and no application'),
        (facts("pr2_teleop"), "application", '"teleop" in its name or repository'),
        (facts("ecl_math", needs=(), nodes=False), "library", "names no robot, no device and no application"),
        (facts("thing_driver", needs=("serial",)), "driver", '"driver" in its name'),
        # Drivers of today, which say so by what they reach their device through.
        (facts("ublox_gps", needs=("rclcpp", "asio")), "driver", 'reaches a device through "asio"'),
        (facts("realsense2", needs=("rclcpp", "librealsense2")), "driver", 'reaches a device through "librealsense2"'),
        (facts("reach_bridge", needs=("rclcpp", "udp_driver")), "driver", 'reaches a device through "udp_driver"'),
    ],
)
def test_roles_with_their_reasons(given, role, reason):
    found = decide(given)
    assert found.role == role
    assert reason in found.reasons
    assert found.margin > 0


@pytest.mark.parametrize(
    ("given", "kind"),
    [
        (facts("arm_description", files=("urdf/arm.xacro", "launch/show.launch")), "description"),
        (facts("arm_msgs", files=("msg/Arm.msg", "setup.py")), "interfaces"),
        (facts("arm_bringup", files=("launch/arm.launch",)), "bringup"),
        (facts("arm_gazebo"), "simulation"),
        (facts("arm_world", files=("launch/a.launch",), needs=("gazebo_ros",)), "simulation"),
        (facts("rqt_arm", files=("src/arm.py",)), "tooling"),
        (facts("arm", files=(), metapackage=True), "metapackage"),
        (facts("arm_node"), ""),
    ],
)
def test_kinds(given, kind):
    found = decide(given)
    assert found.kind == kind
    assert found.shown == (kind or found.role)
    assert kind in ("", *KINDS)


def test_what_sources_include_tells_what_names_do_not():
    given = facts("thing", needs=("rclcpp",))
    assert decide(given).role == "library"
    found = decide(msgspec.structs.replace(given, includes=(RoleInclude("devices", "linux/can.h", "src/a.cpp", 3),)))
    assert found.role == "driver"
    assert found.reasons[0] == 'reaches a device through "linux/can.h", src/a.cpp:3'
    game = facts("arm_game", needs=("rclpy",))
    found = decide(msgspec.structs.replace(game, includes=(RoleInclude("tasks", "moveit_commander", "a.py", 7),)))
    assert found.role == "application"
    assert 'has a robot do something through "moveit_commander", a.py:7' in found.reasons


def test_tests_are_no_code_of_the_package():
    given = facts("arm_msgs", files=("msg/Arm.msg", "test/test_arm.cpp"))
    files = (given.files[0], msgspec.structs.replace(given.files[1], role=Role.TEST))
    assert decide(given).kind == ""
    assert decide(msgspec.structs.replace(given, files=files)).kind == "interfaces"


def test_every_mark_has_a_weight_for_every_role(benchmark):
    rows = benchmark.recorded()
    assert {mark for row in rows for mark in row[3]} | {"bias", *benchmark.PRIOR} == set(weights())
    assert all(set(of) == set(ROLES) for of in weights().values())
    assert set(benchmark.PRIOR) <= set(weights())
    everything = facts(
        "kobuki_teleop_utils_sensor_driver_demo", files=("a.launch", "include/a.hpp", "include/b.hpp", "include/c.hpp"),
        needs=("serial", "driver_base", "kobuki_node"),
        description="A demo of a driver", repository="kobuki_driver", nodes=False,
    )  # fmt: skip
    spoken = Spoken(("geometry_msgs/Twist", "sensor_msgs/Imu"), asked=("move_base_msgs/MoveBaseAction",))
    includes = (
        RoleInclude("devices", "termios.h", "a.cpp", 1),
        RoleInclude("tasks", "moveit_commander", "a.py", 2),
    )
    marks = set(marks_of(msgspec.structs.replace(everything, spoken=spoken, includes=includes)))
    assert marks == set(weights()) - {"bias", "general", "robot_part", "graph_obeys"}


def test_words_are_lower_case_and_whole():
    for group in msgspec.structs.asdict(words()).values():
        assert group
        assert all(word == word.lower().strip() and " " not in word for word in group)


def test_leave_some_repositories_out(benchmark):
    rows = benchmark.recorded()
    found = benchmark.left_out(rows, ["kobuki", "ecl_lite", "turtlebot_apps"])
    wrong = {row[0] for row, reported in zip(rows, found, strict=True) if row[2] != reported}
    assert wrong == {"kobuki_auto_docking", "pano_core"}


@pytest.mark.nightly
def test_leave_one_repository_out(benchmark):
    rows = benchmark.recorded()
    assert len(rows) == 180
    given, found = [row[2] for row in rows], benchmark.left_out(rows)
    right = sum(a == b for a, b in zip(given, found, strict=True))
    assert right == 161
    assert benchmark.kappa(given, found) == pytest.approx(0.815, abs=0.001)


def test_kappa_by_hand(benchmark):
    # 3 of 4 agree; by chance (2 * 1 + 2 * 3) / 16 = 0.5
    assert benchmark.kappa(["driver"] * 2 + ["library"] * 2, ["driver"] + ["library"] * 3) == pytest.approx(0.5)


def test_what_is_held_against_today_is_of_other_repositories_than_the_study(benchmark):
    with benchmark.TODAY.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    studied = {name for _, name, *_ in benchmark.recorded()}
    assert {row["role"] for row in rows} == set(ROLES)
    assert len(rows) == len({row["repository"] for row in rows}) == 57
    assert not {row["repository"].partition("+")[2] for row in rows} & studied
