"""Interfaces of packages with their checksums; what is wrong with one of them does not lose the others."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslens.model.source import Dependency, Language, Location, Package, SourceFile
from roslens.source.extract.workspace import workspace_interfaces
from roslens.source.extract.workspace.workspace_interfaces import interfaces_of, ros_generation

PLACE = Location("package.xml")


def package(name: str, build_type: str = "", *dependencies: str) -> Package:
    depends = tuple(Dependency(one, "depend", PLACE) for one in dependencies)
    return Package(name, name, name, PLACE, build_type=build_type, dependencies=depends)


@pytest.mark.parametrize(
    ("build_type", "dependencies", "generation"),
    [
        ("ament_cmake", (), 2),
        ("ament_python", ("rospy",), 2),
        ("catkin", ("rclcpp",), 1),
        ("cmake", ("rclcpp",), 2),
        ("", ("rosidl_default_generators",), 2),
        ("", ("message_generation",), 1),
        ("", (), 1),
    ],
)
def test_generation(build_type: str, dependencies: tuple[str, ...], generation: int):
    assert ros_generation(package("a", build_type, *dependencies)) == generation


def written(root: Path, contents: dict[str, str]) -> tuple[SourceFile, ...]:
    for path, content in contents.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(content)
    return tuple(SourceFile(path, Language(path.rpartition(".")[2])) for path in contents)


def test_checksums_are_those_of_ros(tmp_path: Path):
    files = written(tmp_path, {"std_msgs/msg/String.msg": "string data\n"})
    found, failures = interfaces_of(str(tmp_path), {"std_msgs": files}, [package("std_msgs", "catkin")])
    assert [(one.interface.full_name, one.path, one.checksum.text) for one in found] == [
        ("std_msgs/msg/String", "std_msgs/msg/String.msg", "992ce8a1687cec8c8bd883ec73ca41d1")
    ]
    assert failures == ()
    found, _ = interfaces_of(str(tmp_path), {"std_msgs": files}, [package("std_msgs", "ament_cmake")])
    assert found[0].checksum.text == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"


def test_messages_of_the_other_generation_are_not_looked_up(tmp_path: Path):
    files = {
        "old": written(tmp_path, {"old/msg/A.msg": "int32 a\n"}),
        "new": written(tmp_path, {"new/msg/B.msg": "old/A a\n"}),
    }
    found, _ = interfaces_of(str(tmp_path), files, [package("old", "catkin"), package("new", "ament_cmake")])
    assert [bool(one.checksum) for one in found] == [True, False]


def test_of_two_of_one_name_the_first_counts(tmp_path: Path):
    files = written(tmp_path, {"a/msg/A.msg": "int32 a\n", "a/old/A.msg": "int64 a\n"})
    found, _ = interfaces_of(str(tmp_path), {"a": tuple(reversed(files))}, [package("a", "catkin")])
    assert [one.path for one in found] == ["a/msg/A.msg"]


def test_what_cannot_be_read_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    files = written(tmp_path, {"a/msg/A.msg": "int32 a\n", "a/msg/B.msg": "what\n", "a/msg/C.msg": "int8 c\n"})
    (tmp_path / "a/msg/A.msg").unlink()
    found, failures = interfaces_of(str(tmp_path), {"a": files}, [package("a", "catkin")])
    assert [(one.location and one.location.path, one.tool) for one in failures] == [
        ("a/msg/A.msg", "read"),
        ("a/msg/B.msg", "interfaces"),
    ]
    assert {one.package for one in failures} == {"a"}
    assert [one.interface.name for one in found] == ["B", "C"]

    def broken(*_: object) -> None:
        raise RuntimeError("no")

    monkeypatch.setattr(workspace_interfaces, "md5_of", broken)
    found, _ = interfaces_of(str(tmp_path), {"a": files}, [package("a", "catkin")])
    assert {one.checksum.unknown for one in found} == {"RuntimeError: no"}
