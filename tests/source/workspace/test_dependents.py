"""Which packages depend on which, also through others, and whether a build is among the dependencies."""

import pytest

from roslens.source.workspace.dependents import dependents_of
from roslens.source.workspace.manifest import read_manifest

HEAD = "<package format='3'><name>{}</name>{}</package>"


def dependents(**manifests):
    return dict(dependents_of([_package(name, tags) for name, tags in manifests.items()]))


def _package(name, tags):
    return read_manifest(HEAD.format(name, tags).encode(), f"{name}/package.xml", {})[0]


@pytest.mark.parametrize(
    ("tags", "expected"),
    [
        ("<depend>a</depend>", (("b", True),)),
        ("<build_depend>a</build_depend>", (("b", True),)),
        ("<test_depend>a</test_depend>", (("b", True),)),
        ("<exec_depend>a</exec_depend>", (("b", False),)),
        ("<exec_depend>a</exec_depend><build_depend>a</build_depend>", (("b", True),)),
        ("<doc_depend>a</doc_depend>", ()),
        ("<exec_depend condition='1 == 2'>a</exec_depend>", ()),
        ("<depend>rclcpp</depend>", ()),
        ("", ()),
    ],
)
def test_kinds_of_dependencies(tags, expected):
    assert dependents(a="", b=tags) == {"a": expected, "b": ()}


def test_they_are_known_through_others():
    found = dependents(a="", b="<exec_depend>a</exec_depend>", c="<depend>b</depend>", d="<exec_depend>c</exec_depend>")
    assert found["a"] == (("b", False), ("c", True), ("d", True))
    assert found["c"] == (("d", False),)


def test_a_build_before_the_last_dependency_counts():
    found = dependents(a="", b="<build_depend>a</build_depend>", c="<exec_depend>b</exec_depend>")
    assert found["a"] == (("b", True), ("c", True))


def test_a_cycle_ends():
    found = dependents(a="<exec_depend>b</exec_depend>", b="<exec_depend>a</exec_depend>")
    assert found == {"a": (("a", False), ("b", False)), "b": (("a", False), ("b", False))}
