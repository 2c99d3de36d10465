"""The manifest reader held against catkin_pkg, the reference reader of ROS."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.dom import minidom

import pytest
from catkin_pkg.package import InvalidPackage, parse_package_string
from catkin_pkg.package import Package as Reference

from roslens.model.failure import Failure
from roslens.model.source import Dependency, Package
from roslens.source.workspace.manifest import read_manifest
from roslens.source.workspace.mistakes import Mistake, mistakes_of

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")

ENVIRONMENTS = (
    {"ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PYTHON_VERSION": "3"},
    {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy", "ROS_PYTHON_VERSION": "3"},
    {"ROS_PYTHON_VERSION": "2"},
)

EXAMPLES = Path(__file__).parents[3] / "examples"

SLOTS = {
    "build": ("build_depends",),
    "build_export": ("build_export_depends",),
    "buildtool": ("buildtool_depends",),
    "buildtool_export": ("buildtool_export_depends",),
    "exec": ("exec_depends",),
    "run": ("build_export_depends", "exec_depends"),
    "depend": ("build_depends", "build_export_depends", "exec_depends"),
    "test": ("test_depends",),
    "doc": ("doc_depends",),
    "conflict": ("conflicts",),
    "replace": ("replaces",),
    "group": ("group_depends",),
}


def corpora() -> Iterator[Path]:
    folder = os.environ.get("ROSLENS_CORPORA", "")
    return Path(folder).rglob("package.xml") if folder else iter(())


def reference(content: bytes, environment: dict[str, str]) -> Reference | None:
    """Read as catkin_pkg does from a file; nothing where it refuses."""
    try:
        package = parse_package_string(content.decode("utf-8"), warnings=[])
        package.evaluate_conditions(environment)
        package.get_build_type()
    except (InvalidPackage, AssertionError, ValueError):
        return None
    return package


def their_dependencies(package: Reference) -> Counter[tuple[object, ...]]:
    found: Counter[tuple[object, ...]] = Counter()
    for slot in {slot for slots in SLOTS.values() for slot in slots}:
        for one in getattr(package, slot):
            keys = ("version_lt", "version_lte", "version_eq", "version_gte", "version_gt")
            constraints = tuple((key, getattr(one, key)) for key in keys if getattr(one, key, None) is not None)
            found[slot, one.name, constraints, one.condition or "", one.evaluated_condition] += 1
    return found


def our_dependencies(dependencies: tuple[Dependency, ...]) -> Counter[tuple[object, ...]]:
    return Counter(
        (slot, one.name, tuple(one.constraints.items()), one.condition, one.active)
        for one in dependencies
        for slot in SLOTS[one.kind]
    )


def canonical(markup: str) -> str:
    """XML with its attributes sorted, so that two ways to write the same compare equal."""
    element = minidom.parseString(f"<x>{markup}</x>").documentElement
    for node in element.getElementsByTagName("*"):
        for name, value in sorted(node.attributes.items()):
            node.removeAttribute(name)
            node.setAttribute(name, value)
    return "".join(child.toxml() for child in element.childNodes)


def assert_agree(ours: Package, theirs: Reference) -> None:
    assert ours.name == theirs.name
    assert ours.version == theirs.version
    assert ours.format == theirs.package_format
    assert ours.description == " ".join(theirs.plaintext_description.split())
    assert [(one.name, one.email) for one in ours.maintainers] == [(one.name, one.email) for one in theirs.maintainers]
    assert [(one.name, one.email) for one in ours.authors] == [(one.name, one.email or "") for one in theirs.authors]
    assert [(one.name, one.file) for one in ours.licenses] == [(str(one), one.file or "") for one in theirs.licenses]
    assert [(one.url, one.kind) for one in ours.urls] == [(one.url, one.type) for one in theirs.urls]
    assert our_dependencies(ours.dependencies) == their_dependencies(theirs)
    members = [(one.name, one.condition, one.active) for one in ours.member_of_groups]
    assert members == [(one.name, one.condition or "", one.evaluated_condition) for one in theirs.member_of_groups]
    assert ours.build_type == theirs.get_build_type()
    assert ours.metapackage == theirs.is_metapackage()
    assert [(one.tag, one.attributes, one.active) for one in ours.exports] == [
        (one.tagname, one.attributes, one.evaluated_condition) for one in theirs.exports
    ]
    for mine, other in zip(ours.exports, theirs.exports, strict=True):
        if mine.content:
            assert canonical(mine.content) == canonical(other.content)
        else:
            assert canonical(mine.text.replace("&", "&amp;").replace("<", "&lt;")) == canonical(other.content)


def reported(
    content: bytes, path: str, environment: Mapping[str, str]
) -> tuple[Package | None, tuple[Failure | Mistake, ...]]:
    """Return the package with what could not be understood and what should be said otherwise."""
    package, failures = read_manifest(content, path, environment)
    return package, (*failures, *mistakes_of(content, path))


def assert_same(content: bytes, path: str) -> None:
    for environment in ENVIRONMENTS:
        ours, failures = reported(content, path, environment)
        theirs = reference(content, environment)
        assert ours is not None
        if theirs is None:
            assert failures, f"{path}: catkin_pkg refuses it, nothing was reported"
        else:
            assert not failures, [str(failure) for failure in failures]
            assert_agree(ours, theirs)


GOOD = ("format_1", "format_2", "format_3", "metapackage", "ament_python")


@pytest.mark.parametrize("name", GOOD)
def test_a_good_manifest_says_what_catkin_pkg_says(manifests: dict[str, bytes], name: str) -> None:
    assert reference(manifests[name], ENVIRONMENTS[0]) is not None, "the fixture is meant to be accepted"
    assert_same(manifests[name], f"{name}/package.xml")


def test_what_catkin_pkg_refuses_is_told(manifests: dict[str, bytes]) -> None:
    faulty = {name: content for name, content in manifests.items() if name.startswith("faulty_")}
    assert len(faulty) >= 6
    for name, content in faulty.items():
        _, failures = reported(content, f"{name}/package.xml", ENVIRONMENTS[1])
        assert failures, name


FAULTS = (
    (r"<name>arm_teleop</name>", ""),
    (r"<name>arm_teleop</name>", "<name>a</name><name>b</name>"),
    (r"<name>arm_teleop", "<name>arm teleop"),
    (r"<name>arm_teleop", "<name>_arm"),
    (r"<name>arm_teleop", "<name>"),
    (r"0\.1\.0", "0.1"),
    (r"0\.1\.0", "0.1.0-rc1"),
    (r"0\.1\.0", "\u0660.\u0661.\u0660"),
    (r"<version>", '<version compatibility="1">'),
    (r"<version>.*</version>", ""),
    (r"<description>.*</description>", ""),
    (r"<description>.*</description>", "<description> </description>"),
    (r"<maintainer.*</maintainer>", ""),
    (r' email="[^"]*"', ""),
    (r' email="[^"]*"', ' email=""'),
    (r' email="[^"]*"', ' email="ada at example"'),
    (r' email="[^"]*"', ' email="ada@localhost"'),
    (r"<license>.*</license>", ""),
    (r"<license>.*</license>", "<license> </license>"),
    (r"<license>", '<license colour="red">'),
    (r'format="3"', 'format="2"><exec_depend condition="$A == b">x</exec_depend'),
    (r'format="3"', 'format="4"'),
    (r'format="3"', 'format="x"'),
    (r'format="3"', 'format="3" shape="round"'),
    (r"exec_depend", "run_depend"),
    (r'format="3"', 'format="1"'),
    (r"<exec_depend>rclpy", "<exec_depend>arm_teleop"),
    (r"<exec_depend>", '<exec_depend condition="$A = b">'),
    (r"<exec_depend>", '<exec_depend condition="">'),
    (r"<exec_depend>", '<exec_depend version="1">'),
    (r"<exec_depend>rclpy", "<exec_depend>rclpy<b/>"),
    (r"<exec_depend>", "<depend>rclpy</depend><exec_depend>"),
    (r"<export>", "<export/><export>"),
    (r"<export>", "<export><build_type>cmake</build_type>"),
    (r"<exec_depend>", "<group_depend>g</group_depend><member_of_group>g</member_of_group><exec_depend>"),
    (r"<export>", "<export colour='red'>"),
    (r"</package>", "</package><package/>"),
    (r"</package>", ""),
)


@pytest.mark.parametrize(("pattern", "replacement"), FAULTS)
def test_each_fault_that_catkin_pkg_refuses_is_told_with_its_place(
    manifests: dict[str, bytes], pattern: str, replacement: str
) -> None:
    content = re.sub(pattern, lambda _: replacement, manifests["ament_python"].decode()).encode()
    assert content != manifests["ament_python"]
    assert reference(content, ENVIRONMENTS[1]) is None, "the fault is meant to be one for catkin_pkg"
    package, failures = reported(content, "arm/package.xml", ENVIRONMENTS[1])
    assert package is not None
    assert package.name in ("arm_teleop", "arm", "a", "arm teleop", "_arm")
    assert failures
    for failure in failures:
        assert failure.location is not None
        assert failure.location.line > 0
        assert failure.location.column > 0
        assert failure.expected
        assert failure.advice
        if isinstance(failure, Failure):
            assert failure.partial
            assert failure.package == package.id


HARMLESS = (
    (r"<name>arm_teleop</name>", "<name> \n arm_teleop\t</name>"),
    (r"<name>arm_teleop", "<name>Arm-Teleop"),
    (r"<name>arm_teleop", "<name><!-- why -->arm_teleop"),
    (r"0\.1\.0", "00.1.0"),
    (r"<export>", "<export xmlns:c='urn:c' c:x='red'>"),
    (r"<exec_depend>", "<exec_depend condition=\"($A==b)or 'x'!=$ROS_VERSION\">"),
    (r"<exec_depend>", '<exec_depend xmlns="urn:x" version_lt="2">'),
    (r"<exec_depend>rclpy</exec_depend>", ""),
    (r"<exec_depend>", "<conflict>arm_teleop</conflict><exec_depend>"),
    (r"ament_python</build_type>", "ament_python</build_type><build_type condition='$ROS_VERSION == 3'>x</build_type>"),
    (r"\n", "\r\n"),
)


@pytest.mark.parametrize(("pattern", "replacement"), HARMLESS)
def test_what_catkin_pkg_accepts_is_accepted(manifests: dict[str, bytes], pattern: str, replacement: str) -> None:
    content = re.sub(pattern, lambda _: replacement, manifests["ament_python"].decode()).encode()
    assert content != manifests["ament_python"]
    assert reference(content, ENVIRONMENTS[1]) is not None, "the change is meant to be harmless for catkin_pkg"
    assert_same(content, "arm/package.xml")


def test_the_shipped_examples_say_what_catkin_pkg_says() -> None:
    found = sorted(EXAMPLES.rglob("package.xml"))
    assert len(found) >= 6
    for path in found:
        assert_same(path.read_bytes(), path.relative_to(EXAMPLES).as_posix())


@pytest.mark.corpora
@pytest.mark.heavy
@pytest.mark.skipif(not os.environ.get("ROSLENS_CORPORA"), reason="ROSLENS_CORPORA names no folder of real packages")
def test_real_manifests_say_what_catkin_pkg_says() -> None:
    found = sorted(corpora())
    assert found
    for path in found:
        assert_same(path.read_bytes(), path.as_posix().lstrip("/"))
