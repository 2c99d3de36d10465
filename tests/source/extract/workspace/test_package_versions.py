import pytest

from roslens.model.source import Dependency, Export, Location, Package
from roslens.source.extract.workspace.package_versions import build_type_for, versions_of

HERE = Location("package.xml", 1)


def package(*named, build_type="ament_cmake", types=()):
    needs = tuple(Dependency(name, "buildtool", HERE, condition) for name, condition in named)
    exports = tuple(Export("build_type", HERE, text, {"condition": condition}) for text, condition in types)
    return Package("a", "a", "a", HERE, build_type=build_type, dependencies=needs, exports=exports)


@pytest.mark.parametrize(
    ("found", "cmake", "versions"),
    [
        (package(("ament_cmake", "")), b"find_package(ament_cmake REQUIRED)", ("ros2",)),
        (package(("catkin", ""), build_type="catkin"), b"find_package(catkin)", ("ros1",)),
        (package(("catkin", "$ROS_VERSION == 1"), ("ament_cmake", "$ROS_VERSION == 2")), b"", ("ros1", "ros2")),
        (package(types=[("catkin", "$ROS_VERSION == 1"), ("ament_cmake", "")]), b"", ("ros1", "ros2")),
        # What is left over from ROS 1 makes no build for it.
        (package(("catkin", ""), ("ament_cmake", "")), b"find_package(ament_cmake REQUIRED)", ("ros2",)),
        (package(), b"find_package(catkin QUIET)\nfind_package(ament_cmake QUIET)", ("ros1", "ros2")),
        (package(), b"# find_package(catkin QUIET)\nfind_package(ament_cmake QUIET)", ("ros2",)),
        (package(build_type="catkin"), b"find_package(ament_cmake)", ("ros2",)),
        (package(build_type="catkin"), b"", ("ros1",)),
    ],
)
def test_versions_of_a_package(found, cmake, versions):
    assert versions_of(found, cmake) == versions


def test_a_manifest_beside_is_for_another_version():
    assert versions_of(package(), b"", ["a/package.xml", "a/package_ROS1.xml"]) == ("ros1", "ros2")


def test_how_a_package_is_built_for_a_version():
    assert build_type_for(package(build_type="ament_python"), "ros2") == "ament_python"
    assert build_type_for(package(build_type="ament_python"), "ros1") == "catkin"
    assert build_type_for(package(build_type="catkin"), "ros2") == "ament_cmake"
