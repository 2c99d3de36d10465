"""Targets that differ only by the side of a condition on which they are made."""

import msgspec
import pytest

from roslens.source.extract.builds.cmake_linking import merged
from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind

ONE = Target(TargetKind.EXECUTABLE, "p", "n", ("a.cpp",), Evidence("p/CMakeLists.txt", 1))


def with_conditions(*conditions):
    return msgspec.structs.replace(ONE, conditions=conditions)


@pytest.mark.parametrize(
    ("one", "other", "left"),
    [
        (("A",), ("NOT (A)",), [()]),
        (("B", "NOT (A)"), ("B", "A"), [("B",)]),
        (("A",), ("A",), [("A",)]),
        (("A",), ("B",), [("A",), ("B",)]),
        (("A",), (), [("A",), ()]),
        (("A", "B"), ("NOT (A)", "NOT (B)"), [("A", "B"), ("NOT (A)", "NOT (B)")]),
    ],
)
def test_merged(one, other, left):
    assert [found.conditions for found in merged([with_conditions(*one), with_conditions(*other)])] == left


def test_other_sources_are_other_targets():
    other = msgspec.structs.replace(ONE, sources=("b.cpp",), conditions=("NOT (A)",))
    assert len(merged([with_conditions("A"), other])) == 2


def test_what_is_installed_on_one_side_is_installed():
    sides = [msgspec.structs.replace(ONE, installed=False, conditions=("A",)), with_conditions("NOT (A)")]
    assert [found.installed for found in merged(sides)] == [True]
