import re
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import slowness

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import (
    Place,
    _fits,
    absolute,
    expand,
    may_match,
    node_pattern_matches,
    renamed,
    resolve,
    rule,
    tidy,
)
from roslens.source.extract.symbolic.text import Text, unknown

HERE = Evidence("a.launch", 1)


def place(generation: str = "ros2", namespace: str = "/ns", name: str = "node") -> Place:
    return Place(Text.of(namespace), absolute(Text.of(namespace), Text.of(name)), generation)


def rules(*pairs: str):
    return tuple(rule(*(Text.of(side) for side in pair.split(":=")), HERE) for pair in pairs)


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
@pytest.mark.parametrize(
    ("given_", "wanted"),
    [
        ("scan", "/ns/scan"),
        ("a/b", "/ns/a/b"),
        ("/scan", "/scan"),
        ("~/scan", "/ns/node/scan"),
        ("~scan", "/ns/node/scan"),
        ("~", "/ns/node"),
        ("scan/", "/ns/scan"),
        ("//a//b", "/a/b"),
    ],
)
def test_names_are_expanded(generation, given_, wanted):
    assert expand(Text.of(given_), place(generation)).known == wanted


def test_names_at_the_top_have_one_separator():
    assert expand(Text.of("scan"), place(namespace="/")).known == "/scan"
    assert expand(Text.of("~/scan"), place(namespace="/")).known == "/node/scan"


def test_ros2_has_names_of_the_node_in_braces():
    assert expand(Text.of("/{node}/x"), place()).known == "/node/x"
    assert expand(Text.of("{ns}/x"), place()).known == "/ns/x"
    assert expand(Text.of("/{node}/x"), place("ros1")).known == "/{node}/x"


def test_a_name_with_a_hole_stays_a_pattern():
    assert expand(Text.of("robot_", *unknown("id").parts, "/scan"), place()).pattern == "/ns/robot_*/scan"
    assert expand(Text.of(*unknown("topic").parts), place()).pattern == "*"


def test_the_first_rule_of_ros2_and_the_last_one_of_ros1_is_applied():
    both = rules("scan:=first", "scan:=last")
    assert resolve(Text.of("scan"), place("ros2"), both)[0].known == "/ns/first"
    assert resolve(Text.of("scan"), place("ros1"), both)[0].known == "/ns/last"


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_a_remapping_is_applied_once_so_that_cycles_end(generation):
    both = rules("a:=b", "b:=a")
    assert resolve(Text.of("a"), place(generation), both)[0].known == "/ns/b"
    assert resolve(Text.of("b"), place(generation), both)[0].known == "/ns/a"


@pytest.mark.parametrize("source", ["/ns/scan", "scan", "rostopic://scan", "node:scan"])
def test_rules_of_ros2_hold_for_expanded_names(source):
    assert resolve(Text.of("/ns/scan"), place(), rules(f"{source}:=/out"))[0].known == "/out"


def test_a_rule_for_another_node_is_not_applied():
    found, by = resolve(Text.of("scan"), place(), rules("other:scan:=/out"))
    assert (found.known, by) == ("/ns/scan", None)


def test_private_names_can_be_remapped():
    assert resolve(Text.of("~/out"), place(), rules("~/out:=odom"))[0].known == "/ns/odom"


def test_a_node_is_renamed():
    assert renamed("__node", "node", rules("__node:=new"), "ros2").target.known == "new"
    assert renamed("__node", "node", rules("other:__node:=new"), "ros2") is None
    assert renamed("__ns", "node", rules("__ns:=/a", "__ns:=/b"), "ros2").target.known == "/a"
    assert renamed("__node", "node", rules("__name:=a"), "ros1").target.known == "a"


def test_a_remapping_of_a_name_with_holes_may_match():
    (one,) = rules("robot_1/scan:=/out")
    with_hole = Text.of("robot_", *unknown("id").parts, "/scan")
    assert may_match(one, with_hole, place())
    assert not may_match(one, Text.of("other_", *unknown("id").parts), place())
    assert not may_match(one, Text.of("robot_1/scan"), place())


@pytest.mark.parametrize(
    ("pattern", "node", "wanted"),
    [
        ("/**", "/a", True),
        ("/**", "/a/b/c", True),
        ("/*", "/a", True),
        ("/*", "/a/b", False),
        ("/a/b", "/a/b", True),
        ("/b", "/a/b", False),
        ("/*/b", "/a/b", True),
        ("/**/b", "/b", True),
        ("/**/b", "/x/y/b", True),
        ("/a/**", "/a/b/c", True),
        ("/a/**", "/b", False),
        ("/a.b", "/axb", False),
    ],
)
def test_files_of_parameters_are_keyed_by_patterns(pattern, node, wanted):
    assert node_pattern_matches(pattern, node) is wanted


NAMES = st.from_regex(r"(/|~/)?[a-z][a-z0-9_]*(/[a-z][a-z0-9_]*){0,2}", fullmatch=True)
NAMESPACES = st.from_regex(r"/|(/[a-z][a-z0-9]*){1,3}", fullmatch=True)


@given(NAMES, NAMESPACES, st.sampled_from(["ros1", "ros2"]))
def test_an_expanded_name_is_global_tidy_and_stays_as_it_is(name, namespace, generation):
    here = place(generation, namespace)
    expanded = expand(Text.of(name), here)
    assert expanded.known is not None
    assert expanded.known.startswith("/")
    assert "//" not in expanded.known
    assert expand(expanded, here) == expanded
    assert tidy(expanded) == expanded


@given(NAMES, NAMES, NAMESPACES, st.sampled_from(["ros1", "ros2"]))
def test_a_remapping_to_itself_changes_nothing(name, other, namespace, generation):
    here = place(generation, namespace)
    one = rule(Text.of(other), Text.of(other), HERE)
    assert resolve(Text.of(name), here, (one,))[0] == expand(Text.of(name), here)


@given(NAMES, NAMES, NAMESPACES)
def test_what_a_remapping_names_goes_where_it_says(name, target, namespace):
    here = place("ros2", namespace)
    found, by = resolve(Text.of(name), here, (rule(Text.of(name), Text.of(target), HERE),))
    assert found == expand(Text.of(target), here)
    assert by is not None


def reference_pattern(pattern):
    pieces = re.split(r"(/\*\*|/\*)", pattern)
    forms = {"/**": r"(?:/\w+)*", "/*": r"(?:/\w+)"}
    return re.compile("".join(forms.get(piece) or re.escape(piece) for piece in pieces))


@given(
    st.lists(st.sampled_from(["/**", "/*", "/a", "/b", "a", "b", "/"]), max_size=6).map("".join),
    st.lists(st.sampled_from(["/a", "/b", "a", "b", "/"]), max_size=6).map("".join),
)
def test_a_key_matches_as_the_expression_that_rclcpp_makes_of_it(pattern, node):
    expected = pattern == node or ("*" in pattern and reference_pattern(pattern).fullmatch(node) is not None)
    assert node_pattern_matches(pattern, node) is expected


@given(
    st.lists(st.one_of(st.none(), st.text("ab/", max_size=3)), max_size=6),
    st.text("ab/", max_size=8),
)
def test_texts_with_anything_between_match_as_an_expression(parts, text):
    expression = "".join(".*" if part is None else re.escape(part) for part in parts)
    assert _fits(parts, text) is (re.fullmatch(expression, text, re.DOTALL) is not None)


def test_no_pattern_takes_long():
    node = "/a" * 60
    begun = time.process_time()
    assert not node_pattern_matches("/**" * 25 + "/c", node)
    assert not _fits([None, "a"] * 25 + ["c"], "a" * 2000)
    assert time.process_time() - begun < 1 * slowness()
