from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind
from roslens.source.extract.ir.program import Program
from roslens.source.extract.workspace.file_versions import file_versions, spoken

HERE = Evidence("p/CMakeLists.txt", 1)
BOTH = ("ros1", "ros2")


def program(*includes, language="cpp", **variants):
    made = {version: program(*names) for version, names in variants.items()}
    return Program(language, includes=tuple((name, line) for line, name in enumerate(includes)), variants=made)


def versions(programs, *, built=BOTH, targets=()):
    owners = dict.fromkeys(programs, "p")
    return file_versions(programs, owners, {}, {"p": built}, {"p": "p"}, targets)


OLD, NEW = program("<ros/ros.h>"), program("<rclcpp/rclcpp.hpp>")


def test_what_is_for_one_version_alone_is_not_told_apart():
    assert versions({"p/a.cpp": OLD, "p/b.cpp": program("<vector>")}) == {}


def test_messages_and_modules_tell_too():
    assert spoken(program("<std_msgs/String.h>")) == {"ros1"}
    assert spoken(program("<std_msgs/msg/string.hpp>")) == {"ros2"}
    assert spoken(program("rclpy.node", language="python")) == {"ros2"}
    assert spoken(program("<own/Thing.h>", "<tf2_ros/buffer.h>")) == set()


def test_what_is_in_one_arm_alone_says_nothing():
    assert spoken(program(ros1=("<ros/ros.h>",), ros2=("<rclcpp/rclcpp.hpp>",))) == set()
    assert spoken(program(ros1=("<ros/ros.h>", "<a.h>"), ros2=("<ros/ros.h>",))) == {"ros1"}


def test_includes_targets_and_names_tell_of_what_does_not_say_itself():
    programs = {
        "p/old.h": OLD,
        "p/new.cpp": NEW,
        "p/by_include.cpp": program('"old.h"'),
        "p/by_target.cpp": program("<vector>"),
        "p/ROS2/by_name.cpp": program("<vector>"),
        "p/shared.cpp": program("<vector>"),
        "p/part.hpp": program("<vector>"),
        "p/of_part.cpp": program('"part.hpp"', "<ros/ros.h>"),
    }
    targets = [
        Target(TargetKind.EXECUTABLE, "p", "n", ("p/by_target.cpp", "p/shared.cpp"), HERE, versions=("ros1",)),
        Target(TargetKind.EXECUTABLE, "p", "n", ("p/shared.cpp",), HERE, versions=("ros2",)),
    ]
    assert versions(programs, targets=targets) == {
        "p/old.h": "ros1",
        "p/new.cpp": "ros2",
        "p/by_include.cpp": "ros1",
        "p/by_target.cpp": "ros1",
        "p/ROS2/by_name.cpp": "ros2",
        "p/part.hpp": "ros1",
        "p/of_part.cpp": "ros1",
    }


def test_of_a_package_for_one_version_the_rest_is_for_that():
    assert versions({"p/a.cpp": OLD, "p/b.cpp": NEW, "p/c.cpp": program()}, built=("ros2",))["p/c.cpp"] == "ros2"
