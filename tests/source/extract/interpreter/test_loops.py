"""Loops turn by turn where that is known, and what holds after ways out of them."""

import pytest

from roslens.source.extract.symbolic.condition import as_written

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"
PYTHON = """
import rospy
from std_msgs.msg import String
def main():
    rospy.init_node('a')
{body}
if __name__ == '__main__':
    main()
"""


def told(facts):
    return [(str(one.name), " and ".join(as_written(one.conditions))) for one in facts.endpoints]


def test_a_loop_that_counts_has_a_turn_for_each_number(node_of):
    body = "for (int i = 0; i < 3; i++) {" + PUB.format('"cam" + std::to_string(i)') + "}"
    assert told(node_of(body)) == [("cam0", ""), ("cam1", ""), ("cam2", "")]
    body = "for (int i = 4; i >= 1; i -= 2) {" + PUB.format('"cam" + std::to_string(i)') + "}"
    assert told(node_of(body)) == [("cam4", ""), ("cam2", "")]


@pytest.mark.parametrize(
    "loop",
    [
        "int i = 0; for (; i < ask(); i++) { PUB }",
        "int i = 0; while (ask()) { PUB i++; }",
        "int i = 0; do { PUB i += 2; } while (ask());",
        "int i = 0; for (auto one : ask()) { PUB ++i; }",
        "for (int i = 0; i < 1000; i++) { PUB }",
    ],
)
def test_what_another_turn_changes_is_unknown(node_of, loop):
    (one,) = node_of(loop.replace("PUB", PUB.format('"cam" + std::to_string(i)'))).endpoints
    assert one.name.pattern == "cam*"


def test_a_text_that_grows_in_a_loop_is_unknown(node_of):
    body = 'std::string t = "a"; while (ask()) {' + PUB.format("t") + 't += "b"; }'
    (one,) = node_of(body).endpoints
    assert one.name.known is None


def test_what_a_loop_sets_may_not_be_set(node_of):
    body = 'std::string t = "a"; while (ask()) { t = "b"; }' + PUB.format("t")
    (one,) = node_of(body).endpoints
    assert one.name.known is None
    body = 'std::string t = "a"; do { t = "b"; } while (ask());' + PUB.format("t")
    (one,) = node_of(body).endpoints
    assert one.name.known == "b"


def test_what_follows_a_way_out_holds_where_it_was_not_taken(node_of):
    body = 'for (auto n : {"a", "b"}) { if (ask()) { continue; }' + PUB.format("n") + "}" + PUB.format('"end"')
    assert told(node_of(body)) == [("a", "not ask()"), ("b", "not ask()"), ("end", "")]
    body = 'for (auto n : {"a", "b"}) {' + PUB.format("n") + " if (ask()) break; }" + PUB.format('"end"')
    assert told(node_of(body)) == [("a", ""), ("b", "not ask()"), ("end", "")]
    inner = " if (ask()) { if (more()) { break; } " + PUB.format('"in"') + "} " + PUB.format('"out"')
    assert told(node_of("while (true) {" + inner + "}")) == [
        ("in", "ask() and not more()"),
        ("out", "not (ask() and more())"),
    ]


def test_a_way_out_without_a_condition_ends_the_loop(node_of):
    body = 'for (auto n : {"a", "b"}) {' + PUB.format("n") + " break;" + PUB.format('"never"') + "}"
    assert told(node_of(body)) == [("a", "")]


def test_what_holds_at_a_way_out_may_hold_after_the_loop(node_of):
    body = 'std::string t = "a"; for (int i = 0; i < 2; i++) { if (ask(i)) { t = "b"; break; } }' + PUB.format("t")
    (one,) = node_of(body).endpoints
    assert one.name.known is None


def test_a_break_of_a_switch_is_none_of_the_loop(node_of):
    body = (
        'for (auto n : {"a", "b"}) { switch (ask()) { case 1: more(); break; default: break; }' + PUB.format("n") + "}"
    )
    assert told(node_of(body)) == [("a", ""), ("b", "")]


def test_ways_out_of_loops_of_python(units):
    body = """
    for name in ('a', 'b'):
        if ask():
            continue
        rospy.Publisher(name, String, queue_size=1)
    n = 0
    while ask():
        rospy.Publisher('c%d' % n, String, queue_size=1)
        n += 1
        break
"""
    facts = next(one for one in units(a_py=PYTHON.format(body=body)) if one.endpoints)
    assert [one.name.pattern for one in facts.endpoints] == ["a", "b", "c*"]
    assert as_written(facts.endpoints[0].conditions) == ("not ask()",)


def test_what_an_earlier_turn_sets_is_not_known_in_the_next(node_of):
    body = 'std::string a = "a"; while (ask()) {' + PUB.format("a") + ' a = "b"; }'
    (one,) = node_of(body).endpoints
    assert one.name.known is None
    body = "bool first = true; while (ask()) { if (first) {" + PUB.format('"a"') + "} else {" + PUB.format('"b"')
    assert [str(one.name) for one in node_of(body + "} first = false; }").endpoints] == ["a", "b"]


def test_what_is_set_before_it_is_read_is_known_in_each_turn(node_of, names):
    body = 'std::string a = "a"; while (ask()) { a = "b";' + PUB.format("a") + "}"
    assert names(node_of(body)) == [("publisher", "b")]


def test_a_way_out_in_a_branch_that_is_decided_is_one_of_what_follows_too(node_of):
    turn = 'if (true) { if (ask()) { continue; } }\ncreate_publisher<std_msgs::msg::String>("a", 1);'
    (one,) = node_of(f"for (int i = 0; i < 2; ++i) {{ {turn} }}").endpoints
    assert as_written(one.conditions) == ("not ask()",)
