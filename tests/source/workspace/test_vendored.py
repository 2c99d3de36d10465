import pytest

from roslens.source.workspace.vendored import named_folders, vendored_folders

OWN = ["p/package.xml", "p/LICENSE", "p/src/a.cpp", "p/src/b.cpp", "p/src/c.cpp", "p/config/arm-1.2/a.yaml"]


@pytest.mark.parametrize(
    ("more", "found"),
    [
        (["p/src/lib/x/LICENSE.txt", "p/src/lib/x/x.cpp", "p/src/lib/x/in/y.h"], ("p/src/lib/x/",)),
        (["p/src/lib/x/COPYING", "p/src/lib/x/x.cpp"], ("p/src/lib/x/",)),
        (["p/date-3.0.4/include/date.h"], ("p/date-3.0.4/",)),
        (["p/include/p/nlohmann/json.hpp"], ("p/include/p/nlohmann/",)),
        (["p/src/lib/x/COPYRIGHT", "p/src/lib/x/LGPL.txt", "p/src/lib/x/x.c"], ("p/src/lib/x/",)),
        (["p/include/mavlink/v1.0/mavlink_helpers.h", "p/include/mavlink/a.h"], ("p/include/mavlink/",)),
        (["p/src/mavlink/bridge.cpp"], ()),
        (["p/src/solvers/gpl.cc", "p/src/solvers/gpl.h"], ()),
        (["p/docs/license.rst", "p/docs/conf.py"], ()),
        (["p/src/lib/x/license.h", "p/src/lib/x/x.cpp"], ()),
        (["p/meshes/LICENSE", "p/meshes/a.stl"], ()),
        (["p/data_2.1/a.cpp", "p/v1.2/b.cpp"], ("p/data_2.1/",)),
        (["p/include/p/Eigen/Eigen/src/Core/Map.h"], ("p/include/p/Eigen/",)),
        (["p/include/p/Eigen/unsupported/a.h", "p/include/p/Eigen/src/Core/Map.h"], ("p/include/p/Eigen/",)),
        (["p/include/p/eigen/conversions.h"], ()),
        (["p/src/LICENSE", "p/include/p/a.h", "p/include/p/b.h", "p/include/p/c.h", "p/test/t.cpp"], ()),
        (["p/glm/third/LICENSE", "p/glm/third/a.h"], ("p/glm/",)),
        (["p/wrap/include/sensor_msgs/iterator.h", "p/wrap/include/wrap/a.h"], ("p/wrap/include/sensor_msgs/",)),
        (["p/src/sensor_msgs/convert.cpp", "p/include/p/sensor_msgs/convert.h"], ()),
        (["p/src/quadProgpp/QuadProg++.cc"], ("p/src/quadProgpp/",)),
        (["p/dlib/dlib/matrix.h", "p/dlib/dlib_backup/matrix.h"], ("p/dlib/",)),
        (["p/src/dlib_detector/a.cpp"], ()),
        (["p/include/rosbag/bag.h"], ()),
        (["p/sdk/README.md", "p/sdk/CMakeLists.txt", "p/sdk/ChangeLog", "p/sdk/a.cpp"], ("p/sdk/",)),
        (["p/sdk/README.md", "p/sdk/CMakeLists.txt", "p/sdk/lib/libsdk.so", "p/sdk/a.h"], ("p/sdk/",)),
        (["p/firmware/README.md", "p/firmware/CMakeLists.txt", "p/firmware/a.cpp"], ()),
        (["p/sdk/README.md", "p/sdk/lib/libsdk.so", "p/sdk/a.h"], ()),
        ([], ()),
    ],
)
def test_folders_of_others(more, found):
    assert vendored_folders("p", [*OWN, *more]) == (*found,)


def test_the_folder_of_the_package_is_none():
    paths = ["src/qwt-6.1.0/LICENSE", "src/qwt-6.1.0/a.cpp"]
    assert vendored_folders("src/qwt-6.1.0", paths) == ()
    assert vendored_folders(".", ["LICENSE", "a.cpp"]) == ()


def test_a_folder_with_most_of_the_sources_is_the_package_itself():
    assert vendored_folders("p", ["p/p/LICENSE", "p/p/a.py", "p/p/b.py", "p/setup.py"]) == ()


def test_headers_of_the_package_itself_are_its_own():
    paths = ["msgs/package.xml", "msgs/include/sensor_msgs/fill_image.h", "msgs/src/a.cpp", "msgs/src/b.cpp"]
    assert vendored_folders("msgs", paths, "sensor_msgs") == ()
    assert vendored_folders("msgs", paths, "robot") == ("msgs/include/sensor_msgs/",)


def test_a_project_with_most_of_the_sources_is_the_package_itself():
    assert vendored_folders("p", ["p/core/README", "p/core/Makefile", "p/core/AUTHORS", "p/core/a.c"]) == ()


def test_outside_of_packages_names_alone_tell():
    paths = ["src/eigen3.3.2/bench/a.cpp", "src/libcvd/b.cc", "src/arm/LICENSE", "src/arm/c.cpp", "d.cpp"]
    assert named_folders(paths) == ("src/eigen3.3.2/", "src/libcvd/")


def test_a_folder_with_packages_in_it_may_have_a_version():
    paths = ["src/robot_v0.2/tools/a.py", "src/eigen3.3.2/bench/a.cpp"]
    assert named_folders(paths, ["src/robot_v0.2/arm", "src/eigen"]) == ("src/eigen3.3.2/",)
