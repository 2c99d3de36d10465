from roslens.model.source import Dependency, Location, Package
from roslens.source.rules.graph.brought_along import brought_by, may_be_brought_by

HERE = Location("package.xml", 1)


def package(name, *depends, kind="depend"):
    return Package(name, name, name, HERE, dependencies=tuple(Dependency(one, kind, HERE) for one in depends))


def test_what_is_known_of_packages_that_many_depend_on():
    assert brought_by(package("a", "rclcpp", "nav_msgs"), "geometry_msgs", ()) == "nav_msgs"
    assert brought_by(package("a", "common_interfaces"), "sensor_msgs", ()) == "common_interfaces"
    assert brought_by(package("a", "rclcpp"), "std_msgs", ()) == ""


def test_packages_of_the_workspace_hand_on_what_they_export():
    middle = package("middle", "sensor_msgs")
    assert brought_by(package("a", "middle"), "geometry_msgs", (middle,)) == "middle"
    assert brought_by(package("a", "middle"), "sensor_msgs", (package("middle", "sensor_msgs", kind="build"),)) == ""
    assert brought_by(package("a", "middle", kind="test"), "sensor_msgs", (middle,)) == ""


def test_collections_bring_their_interfaces():
    assert brought_by(package("a", "navigation2"), "nav2_msgs", ()) == "navigation2"
    assert brought_by(package("a", "nav2_bringup"), "nav2_msgs", ()) == "nav2_bringup"
    assert brought_by(package("a", "ros_gz"), "ros_gz_interfaces", ()) == "ros_gz"
    assert brought_by(package("a", "navigation2"), "ros_gz_interfaces", ()) == ""


def test_clients_and_drivers_bring_what_they_speak():
    library = package("library", "rclcpp")
    assert brought_by(package("a", "library"), "rosgraph_msgs", (library,)) == "library"
    assert brought_by(package("a", "rclpy"), "rosgraph_msgs", ()) == "rclpy"
    assert brought_by(package("a", "spacenav_node"), "sensor_msgs", ()) == "spacenav_node"


def test_packages_of_the_same_family_may_bring_its_interfaces():
    assert may_be_brought_by(package("a", "rclcpp", "arm_driver"), "arm_msgs", ()) == "arm_driver"
    assert may_be_brought_by(package("a", "arm"), "arm_interfaces", ()) == "arm"
    assert may_be_brought_by(package("a", "armour", "leg"), "arm_msgs", ()) == ""
    assert may_be_brought_by(package("a", "arm_driver"), "arm_msgs", (package("arm_driver"),)) == ""


def test_packages_that_depend_on_each_other_end():
    assert brought_by(package("a", "b"), "x", (package("a", "b"), package("b", "c"), package("c", "b", "a"))) == ""


def test_interfaces_of_which_nothing_is_known_may_have_those_that_many_use():
    assert may_be_brought_by(package("a", "duckietown_msgs"), "sensor_msgs", ()) == "duckietown_msgs"
    assert may_be_brought_by(package("a", "duckietown_msgs"), "grasping_msgs", ()) == ""
    assert may_be_brought_by(package("a", "duckietown_msgs"), "sensor_msgs", (package("duckietown_msgs"),)) == ""
    assert may_be_brought_by(package("a", "nav_msgs", "rclcpp"), "sensor_msgs", ()) == ""
