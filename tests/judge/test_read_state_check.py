"""Lifecycle states and values of parameters in reference documents."""

from __future__ import annotations

import pytest

from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference, read_references
from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.expectation import StateOf
from roslens.judge.reference.merge_references import merge_references
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError


def read(*constraints, namespace=""):
    lines = ["kind: reference", "name: rover", *([f"namespace: {namespace}"] if namespace else []), "constraints:"]
    text = "\n".join([*lines, *(f"  - {one}" for one in constraints)])
    return load_reference([GivenText("rover.yaml", text.encode())], BY_KEY)


def test_a_lifecycle_state_is_expected_of_nodes():
    (check,) = read("{node: '/map*', lifecycle: active, severity: error}").states
    assert (check.of, check.allowed, check.range) == (StateOf.LIFECYCLE, ("active",), None)
    assert (check.selector.kind, check.selector.name) == (EntityKind.NODE, "/map*")
    assert check.details.id == "rover.node.map*.lifecycle"
    assert (subject_words(check), expected_words(check)) == ("node /map*", "lifecycle active")


@pytest.mark.parametrize(
    ("value", "allowed", "range_"),
    [
        ("true", ("true",), None),
        ("[a, b]", ("a", "b"), None),
        ("0.2..0.5", (), Range(0.2, 0.5)),
        ("'<= 3'", (), Range(None, 3.0)),
        ("../maps", ("../maps",), None),
        ("5", ("5",), None),
    ],
)
def test_a_value_is_a_text_a_list_or_a_range(value, allowed, range_):
    (check,) = read(f"{{parameter: /base/speed, value: {value}}}", namespace="/robot").states
    assert (check.allowed, check.range) == (allowed, range_)
    assert check.selector.kind is EntityKind.PARAMETER


def test_a_parameter_can_be_expected_to_be_there():
    (presence,) = read("{parameter: /base/speed, expected: always}").presences
    assert presence.selector.kind is EntityKind.PARAMETER


@pytest.mark.parametrize(
    ("constraint", "said"),
    [
        ("{topic: /a, lifecycle: active}", "'lifecycle' of a topic; expected it of a node"),
        ("{node: /a, value: 3}", "'value' of a node; expected it of a parameter"),
        ("{node: /a, lifecycle: actve}", "lifecycle is 'actve'; expected one of unconfigured, inactive"),
        ("{parameter: /a/b}", "a constraint that expects nothing"),
    ],
)
def test_what_is_wrong_is_said(constraint, said):
    with pytest.raises(DocumentError) as caught:
        read(constraint)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("one", "other", "apart"),
    [
        ("true", "false", True),
        ("5", "5.0", False),
        ("[a, b]", "[b, c]", False),
        ("1..2", "3..4", True),
        ("1..2", "[2, x]", False),
        ("1..2", "[3, x]", True),
    ],
)
def test_two_that_no_value_can_satisfy_contradict_each_other(one, other, apart):
    text = (
        f"kind: reference\nname: r\nconstraints:\n  - {{parameter: '/*/x', value: {one}}}\n"
        f"  - {{parameter: /a/x, value: {other}}}\n"
    )
    merged = merge_references(read_references([GivenText("r.yaml", text.encode())], BY_KEY))
    assert bool(merged.contradictions) is apart
