import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.errors import DocumentError
from roslens.source.extract.facts.node_facts import Terms
from roslens.source.extract.parameters.parameter_library import declarations_of, parameter_library

FILE = b"""\
demo:
  rate: {
    type: double,
    default_value: 10.0,
    description: "How often,
      in hertz",
    validation: {
      bounds<>: [1.0, 100.0]
    }
  }
  joints:
    type: string_array
    default_value: []
    read_only: true
    validation:
      unique<>: null
      size_gt<>: [0]
      subset_of<>: [["a", "b"]]
  gains:
    __map_joints:
      p: {type: double, validation: {gt<>: [0.0], lt_eq: 5}}
  mode:
    type: string
    default_value: "fast"
    additional_constraints: "no others"
    validation:
      one_of<>: [["fast", "slow"]]
      "demo::checks_mode": null
  name:
    type: string_fixed_25
    validation: {not_empty<>: null}
  old: {type: none}
"""


def test_a_file_declares_parameters():
    namespace, found = declarations_of(FILE, "p.yaml")
    assert namespace == "demo"
    assert [(one.name, one.type, one.default, one.range, one.evidence.line) for one in found] == [
        ("rate", "double", "10.0", "1.0..100.0", 2),
        ("joints", "string_array", "[]", "", 11),
        ("gains.__map_joints.p", "double", None, ">0.0..5", 21),
        ("mode", "string", "fast", "", 22),
        ("name", "string", None, "", 29),
    ]
    assert [one.terms for one in found] == [
        Terms(),
        Terms(read_only=True, constraints=("no duplicate items", "size above 0", "items among a, b")),
        Terms(),
        Terms(allowed=("fast", "slow"), constraints=("checked by demo::checks_mode", "no others")),
        Terms(constraints=("not empty", "at most 25 characters")),
    ]
    assert found[0].description == "How often, in hertz"


@pytest.mark.parametrize(
    ("validation", "range_", "words"),
    [
        (b"{gt<>: [0]}", ">0..", ()),
        (b"{lt<>: 1e-3, gt_eq: -.5}", "-.5..<1e-3", ()),
        (b"{bounds: [0]}", "", ("bounds 0",)),
        (b"{element_bounds<>: [0, 1]}", "", ("items in 0..1",)),
        (b"{lower_element_bounds<>: 0, upper_element_bounds<>: [1]}", "", ("items in 0..", "items in ..1")),
        (b"{fixed_size<>: 6, size_lt<>: [9]}", "", ("size 6", "size below 9")),
        (b"{odd<>: [1]}", "", ("odd 1",)),
    ],
)
def test_what_is_checked(validation, range_, words):
    _, (one,) = declarations_of(b"a: {x: {type: int, validation: %s}}" % validation, "p.yaml")
    assert (one.range, one.terms.constraints) == (range_, words)


@pytest.mark.parametrize("content", [b"", b"- a\n", b"a: {}\nb: {}\n", b"a: [\n"])
def test_what_is_no_such_file_is_told(content):
    with pytest.raises(DocumentError):
        declarations_of(content, "p.yaml")
    found = parameter_library("p", "pkg", "p.yaml", content, python=False)
    assert (found.declarations, found.unread[:6]) == ((), "p.yaml")
    assert parameter_library("p", "pkg", "p.yaml", None, python=False).unread == "p.yaml cannot be read"


def test_odd_values_are_left_out():
    _, found = declarations_of(b"a: {x: 5, y: {type: int}, z: [1], w: {}, v: {type: [1]}}", "p.yaml")
    assert found == ()
    _, found = declarations_of(b"a: {y: {type: int}, x: 5, w: {}, v: {type: [1]}}", "p.yaml")
    assert [one.name for one in found] == ["y"]


WORDS = (
    "type",
    "default_value",
    "validation",
    "read_only",
    "description",
    "__map_x",
    "x",
    "gt<>",
    "bounds<>",
    "one_of<>",
)
LEAVES = st.one_of(st.text(max_size=5), st.integers(), st.floats(), st.none(), st.booleans(), st.just("int"))
TREES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(st.sampled_from(WORDS), inner, max_size=4)),
    max_leaves=12,
)


@given(st.dictionaries(st.sampled_from(WORDS), TREES, max_size=2))
def test_any_file_is_read_or_told(tree):
    content = yaml.safe_dump(tree, allow_unicode=True).encode("utf-8", "surrogatepass")
    found = parameter_library("t", "pkg", "p.yaml", content, python=False)
    assert not (found.unread and found.declarations)
