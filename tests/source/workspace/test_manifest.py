"""The facts of a manifest, their places, and what is reported of a broken one."""

from __future__ import annotations

import time

import pytest
from pace import turned_s

from roslens.model.source import Dependency, Location, Package
from roslens.source.workspace.manifest import MAXIMUM_SIZE, read_manifest
from roslens.source.workspace.mistakes import mistakes_of

ROS_2 = {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy", "ROS_PYTHON_VERSION": "3"}
ROS_1 = {"ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PYTHON_VERSION": "3"}


def read(content: bytes, path: str = "src/arm/package.xml", environment: dict[str, str] = ROS_2) -> Package:
    package, failures = read_manifest(content, path, environment)
    assert [str(failure) for failure in failures] == []
    assert package is not None
    return package


def covered(content: bytes, location: Location | None) -> str:
    """The text that a location names."""
    assert location is not None
    lines = content.split(b"\n")
    if location.line == location.end_line:
        return lines[location.line - 1][location.column - 1 : location.end_column].decode()
    first = lines[location.line - 1][location.column - 1 :]
    middle = lines[location.line : location.end_line - 1]
    return b"\n".join((first, *middle, lines[location.end_line - 1][: location.end_column])).decode()


def test_every_fact_has_its_place(manifests: dict[str, bytes]) -> None:
    content = manifests["format_1"]
    package = read(content)
    assert package.manifest == Location("src/arm/package.xml", 2, 3, 2, 25)
    assert covered(content, package.manifest) == "<name>arm_driver</name>"
    for person, tag in [(p, "maintainer") for p in package.maintainers] + [(p, "author") for p in package.authors]:
        assert covered(content, person.location).startswith(f"<{tag}")
        assert covered(content, person.location).endswith(f"{person.name}</{tag}>")
    for licence in package.licenses:
        assert covered(content, licence.location) == f"<license>{licence.name}</license>"
    for url in package.urls:
        assert covered(content, url.location).endswith(f"{url.url}</url>")
    for dependency in package.dependencies:
        text = covered(content, dependency.location)
        assert text.startswith(f"<{dependency.kind}")
        assert f">{dependency.name}<" in text
    assert [covered(content, export.location)[:12] for export in package.exports] == [
        "<nodelet plu",
        "<cpp cflags=",
        "<deprecated>",
        "<architectur",
    ]
    assert covered(content, package.exports[0].location).endswith("/>")


def test_columns_count_bytes(manifests: dict[str, bytes]) -> None:
    content = "<package><!-- ü --><name>arm</name></package>".encode()
    package, _ = read_manifest(content, "arm/package.xml", ROS_2)
    assert package is not None
    assert package.manifest == Location("arm/package.xml", 1, 21, 1, 36)


def test_format_1(manifests: dict[str, bytes]) -> None:
    package = read(manifests["format_1"])
    assert (package.id, package.name, package.path, package.format) == ("arm_driver", "arm_driver", "src/arm", 1)
    assert package.version == "0.4.12"
    assert package.description == "Moves the arm; see its page. Second line."
    assert package.build_type == "catkin"
    assert package.deprecated == "Use arm_driver_2."
    assert [(person.name, person.email) for person in package.maintainers] == [
        ("Ada Löwe", "ada@example.org"),
        ("Ben", "ben.o_k%x+y@mail.example.co.uk"),
    ]
    assert [(dependency.kind, dependency.name) for dependency in package.dependencies] == [
        ("buildtool", "catkin"),
        ("build", "roscpp"),
        ("build", "std_msgs"),
        ("run", "roscpp"),
        ("run", "std_msgs"),
        ("test", "rostest"),
        ("conflict", "arm_driver_old"),
        ("replace", "arm"),
    ]
    assert package.dependencies[2].constraints == {"version_gte": "1.2.0", "version_lt": "2.0.0"}
    assert [url.kind for url in package.urls] == ["website", "bugtracker", "website"]
    assert package.exports[0].attributes == {"plugin": "${prefix}/plugins/nodelets.xml"}
    assert package.repository == ""


@pytest.mark.parametrize(
    ("environment", "build_type", "tool", "groups"),
    [(ROS_1, "catkin", "catkin", ["ros1_only"]), (ROS_2, "ament_cmake", "ament_cmake", [])],
)
def test_conditions_choose(
    manifests: dict[str, bytes], environment: dict[str, str], build_type: str, tool: str, groups: list[str]
) -> None:
    package = read(manifests["format_3"], environment=environment)
    assert package.build_type == build_type
    assert [one.name for one in package.dependencies if one.kind == "buildtool" and one.active] == [tool]
    active = [one.name for one in package.member_of_groups if one.active]
    assert active == ["rosidl_interface_packages", *groups]
    assert [(one.kind, one.name) for one in package.dependencies][-1] == ("group", "rosidl_runtime_packages")
    assert (package.licenses[0].name, package.licenses[0].file) == ("Apache-2.0", "LICENSE")
    rosbag = package.exports[-1]
    assert rosbag.content == '<extra a="1">x<b/>y</extra>'
    assert [export.active for export in package.exports] == [environment is ROS_1, environment is ROS_2, True]


def test_metapackage(manifests: dict[str, bytes]) -> None:
    assert read(manifests["metapackage"]).metapackage
    assert not read(manifests["format_2"]).metapackage


def test_latin_1_is_read_as_declared(manifests: dict[str, bytes]) -> None:
    package = read(manifests["latin_1_declared"])
    assert (package.description, package.maintainers[0].name) == ("Grüße", "Jörg")


def test_undeclared_latin_1_is_told_and_read(manifests: dict[str, bytes]) -> None:
    package, failures = read_manifest(manifests["faulty_latin_1"], "a/package.xml", ROS_2)
    assert package is not None
    assert (package.name, package.maintainers[0].name) == ("latin", "Jörg")
    assert len(failures) == 1
    assert str(failures[0]) == (
        'a/package.xml:4:18: the byte "0xFC" is not UTF-8; expected UTF-8 or a declared encoding.'
        " Save the file as UTF-8; it was read as Latin-1."
    )


def test_what_stands_before_broken_xml_is_kept(manifests: dict[str, bytes]) -> None:
    content = manifests["format_2"].replace(b"<exec_depend>", b"<exec_depend<", 1)
    package, failures = read_manifest(content, "elsewhere/package.xml", ROS_2)
    assert package is not None
    assert package.name == "arm_control"
    assert [one.name for one in package.dependencies if one.kind == "depend"] == ["roscpp", "sensor_msgs"]
    assert len(failures) == 1
    assert failures[0].what.startswith("broken XML")
    assert failures[0].location is not None
    assert failures[0].location.line == 15


def test_a_name_that_is_missing_is_the_folder(manifests: dict[str, bytes]) -> None:
    package, failures = read_manifest(manifests["faulty_nameless"], "src/arm_base/package.xml", ROS_2)
    assert package is not None
    assert (package.name, package.path) == ("arm_base", "src/arm_base")
    assert package.dependencies == (Dependency("rclcpp", "depend", Location("src/arm_base/package.xml", 6, 3, 6, 25)),)
    assert len(failures) == 1
    assert str(failures[0]) == (
        "src/arm_base/package.xml:1:1: the manifest has no <name>; expected <name>."
        " Add it; the folder names the package until then."
    )


def test_without_a_name_and_a_folder_there_is_no_package(manifests: dict[str, bytes]) -> None:
    package, failures = read_manifest(manifests["faulty_nameless"], "package.xml", ROS_2)
    assert package is None
    assert failures


def test_another_root_is_told(manifests: dict[str, bytes]) -> None:
    package, failures = read_manifest(manifests["faulty_root"], "arm/package.xml", ROS_2)
    assert package is not None
    assert package.name == "arm"
    assert [failure.what for failure in failures] == ['the root is "<stack>"']


@pytest.mark.parametrize("content", [b"", b"\0", b" \n", b"\xff\xfe", b"not xml"])
def test_no_xml_at_all_is_told(content: bytes) -> None:
    package, failures = read_manifest(content, "arm/package.xml", ROS_2)
    assert package is not None
    assert package.name == "arm"
    assert len(failures) == 1
    assert failures[0].package == "arm"


def test_everything_wrong_is_told_at_once(manifests: dict[str, bytes]) -> None:
    package, failures = read_manifest(manifests["faulty_everything"], "arm/package.xml", ROS_2)
    assert package is not None
    assert package.name == "Arm Teleop"
    mistakes = mistakes_of(manifests["faulty_everything"], "arm/package.xml")
    found = {one.what for one in (*failures, *mistakes)}
    assert {failure.what for failure in failures} == {
        'the condition "$ROS_VERSION = 2" of <depend> cannot be read at "="',
        '2 build types apply at once, "ament_cmake", "ament_python"',
    }
    assert found >= {
        'the name is "Arm Teleop"',
        'the version is "1.0"',
        "<version> occurs more than once",
        "the description is empty",
        'the maintainer "Ada" has no e-mail address',
        'the e-mail address of "Ben" is "nobody"',
        "the licence is empty",
        "<run_depend> is not a tag of format 3",
        "<depend> is empty",
        'the condition "$ROS_VERSION = 2" of <depend> cannot be read at "="',
        '<depend> "rclpy" duplicates <exec_depend>',
        '<build_depend> has the attribute "priority"',
        "<b> is nested in <build_depend>",
        'the package depends on the group "arms" and is a member of it',
        'the package depends on itself by <depend> "Arm Teleop"',
        "<nonsense> is not a tag of format 3",
        '2 build types apply at once, "ament_cmake", "ament_python"',
        "<export> occurs more than once",
        '<package> has the attribute "colour"',
    }
    assert len(found) == 19
    assert "roscpp" in [dependency.name for dependency in package.dependencies]


def test_a_condition_that_cannot_be_read_is_taken_to_hold(manifests: dict[str, bytes]) -> None:
    package, _ = read_manifest(manifests["faulty_everything"], "arm/package.xml", ROS_1)
    assert package is not None
    assert [one.active for one in package.dependencies if one.name == "rclcpp"] == [True]


@pytest.mark.timed
def test_entities_are_refused_at_once(manifests: dict[str, bytes]) -> None:
    started = time.process_time()
    package, failures = read_manifest(manifests["faulty_entities"], "arm/package.xml", ROS_2)
    assert turned_s(started) < 1
    assert package is not None
    assert package.name == "arm"
    assert failures[0].what == 'the document declares an entity "a"'
    assert failures[0].location is not None
    assert failures[0].location.line == 3


def test_an_external_entity_is_not_read(tmp_path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret_name")
    content = f'<!DOCTYPE p [<!ENTITY x SYSTEM "{secret.as_uri()}">]><package><name>&x;</name></package>'.encode()
    package, failures = read_manifest(content, "arm/package.xml", ROS_2)
    assert package is not None
    assert package.name == "arm"
    assert failures


def test_a_huge_manifest_is_refused() -> None:
    package, failures = read_manifest(b"<" + b"a" * MAXIMUM_SIZE, "arm/package.xml", ROS_2)
    assert package is not None
    assert package.name == "arm"
    assert failures[0].what == "the manifest is larger than 1048576 bytes"


@pytest.mark.timed
def test_a_manifest_of_the_largest_size_is_read_in_seconds() -> None:
    tag = b"<depend>a</depend>\n"
    content = b"<package><name>arm</name>" + tag * (MAXIMUM_SIZE // len(tag) - 2) + b"</package>"
    started = time.process_time()
    package, _ = read_manifest(content, "arm/package.xml", ROS_2)
    assert turned_s(started) < 20
    assert package is not None
    assert len(package.dependencies) > 50_000


@pytest.mark.parametrize(
    ("depends", "build_type"),
    [
        ("", "catkin"),
        ("<depend>rclcpp</depend>", "ament_cmake"),
        ("<buildtool_depend>ament_cmake</buildtool_depend><depend>std_msgs</depend>", "ament_cmake"),
        ("<buildtool_depend>ament_cmake_auto</buildtool_depend>", "ament_cmake"),
        ("<buildtool_depend>ament_python</buildtool_depend><depend>rclpy</depend>", "ament_python"),
        ("<buildtool_depend>catkin</buildtool_depend><depend>rclcpp</depend>", "catkin"),
        ("<depend>roscpp</depend>", "catkin"),
        ('<depend condition="$ROS_VERSION == 1">roscpp</depend><depend>rclcpp</depend>', "ament_cmake"),
    ],
)
def test_without_a_build_type_what_it_depends_on_tells_the_generation(depends: str, build_type: str) -> None:
    content = f"<package format='3'><name>a</name>{depends}</package>".encode()
    package, _ = read_manifest(content, "a/package.xml", ROS_2)
    assert package is not None
    assert package.build_type == build_type
