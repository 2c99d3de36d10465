from roslens.model.configuration import Origin
from roslens.model.finding import Severity
from roslens.model.source import Dependency, Location, Package
from roslens.source.rules.graph.dependency import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node


def package(name, *depends, path=None, kind="depend"):
    place = Location(f"{path or name}/package.xml", 1)
    return Package(name, name, path or name, place, dependencies=tuple(Dependency(one, kind, place) for one in depends))


def findings(*packages, path="slam/src/slam.cpp", kind="sensor_msgs/msg/LaserScan", **more):
    ends = (end("sub", "/scan", kind, 7, path=path, **more), end("sub", "/scan2", kind, 8, path=path, **more))
    return list(found(configuration(node("/slam", *ends)), Surroundings(packages=packages)))


def test_an_interface_package_that_is_not_declared_is_told_once():
    (one,) = findings(package("slam", "std_msgs"))
    assert (one.path, one.line, one.entity) == ("slam/src/slam.cpp", 7, "package:slam")
    assert one.message == (
        "/slam (slam/src/slam.cpp:7) subscribes to /scan as sensor_msgs/msg/LaserScan, but slam/package.xml does "
        "not depend on `sensor_msgs`. Add `<depend>sensor_msgs</depend>`."
    )


def test_what_is_declared_own_unknown_or_of_others_is_none():
    assert not findings(package("slam", "sensor_msgs"))
    assert not findings(package("slam", "sensor_msgs", kind="exec"))
    assert not findings(package("sensor_msgs", path="slam"))
    assert not findings(package("slam"), kind="")
    assert not findings(package("slam"), kind="tf2_msgs/msg/TFMessage")
    assert not findings(package("slam"), path="other/src/x.cpp")
    assert not findings(package("slam"), origin=Origin.CATALOGUE)


def test_a_dependency_for_tests_alone_is_not_enough():
    assert len(findings(package("slam", "sensor_msgs", kind="test"))) == 1


def test_the_innermost_package_counts():
    assert not findings(package("all", path="."), package("slam", "sensor_msgs"))


def test_what_a_dependency_brings_along_is_a_note():
    (one,) = findings(package("slam", "laser_geometry"))
    assert one.severity is Severity.NOTE
    assert "`sensor_msgs`. It is available because `laser_geometry` depends on it. Add" in one.message
