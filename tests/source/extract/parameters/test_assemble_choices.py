"""Texts that are one thing or another, with what launch files set."""

import pytest

from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Role, Sure
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_choices import alternatives, as_decided, chosen_of
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.reason import NotSet, OfParameter
from roslens.source.extract.symbolic.text import (
    And,
    AreEqual,
    Choice,
    Hole,
    IsSet,
    IsTrue,
    Not,
    Or,
    Text,
    Written,
    unknown,
)

ROS1 = Place(Text.of("/ns"), Text.of("/ns/node"), "ros1")
ROS2 = Place(Text.of("/ns"), Text.of("/ns/node"), "ros2")


def values(place=ROS2, **given):
    where = Evidence("a.yaml", 1)
    return Values(place, tuple(Setting(Text.of(name), Text.of(value), where) for name, value in given.items()))


def parameter(name, default=None):
    return Text((Hole(OfParameter(str(name)), name, default),))


def choice(then, otherwise, test=None, condition="c"):
    held = Choice(Written(condition), Text.of(then), Text.of(otherwise), () if test is None else (test,))
    return Text((Hole("one or the other", choice=(held,)),))


def told(text, held):
    return [(str(one.text), as_written(one.conditions), one.sure) for one in alternatives(text, held)]


def test_both_stand_there_with_their_conditions_where_nothing_decides():
    assert told(choice("a", "b"), values()) == [("a", ("c",), Sure.CERTAIN), ("b", ("not c",), Sure.CERTAIN)]
    inside = choice("a", choice("b", "a", condition="d"))
    assert [one[:2] for one in told(inside, values())] == [
        ("a", ("c",)),
        ("b", ("not c", "d")),
        ("a", ("not c", "not d")),
    ]


def test_what_is_set_decides():
    text = Text.of("x/", choice("a", "b", IsTrue(parameter("p", "true"))))
    assert told(text, values(p="false")) == [("x/b", (), Sure.CERTAIN)]
    assert told(text, values(p="1")) == [("x/a", (), Sure.CERTAIN)]
    assert told(text, values()) == [("x/a", (), Sure.LIKELY)]


def test_comparisons_and_what_is_joined():
    equal = AreEqual(parameter("m"), Text.of("fast"))
    both = And((equal, Not(IsTrue(parameter("p")))))
    assert told(choice("a", "b", equal), values(m="fast"))[0][0] == "a"
    assert told(choice("a", "b", Not(equal)), values(m="fast"))[0][0] == "b"
    assert told(choice("a", "b", both), values(m="fast", p="no"))[0][0] == "a"
    assert told(choice("a", "b", both), values(m="slow"))[0][0] == "b"
    assert len(told(choice("a", "b", both), values(m="fast"))) == 2
    assert told(choice("a", "b", Or((equal, both))), values(m="fast"))[0][0] == "a"
    number = AreEqual(parameter("n"), Text.of("2"))
    assert told(choice("a", "b", number), values(n="2.0"))[0][0] == "a"


def test_a_parameter_that_is_set_or_not():
    text = choice("usual", parameter("~t"), Not(IsSet(parameter("~t"))))
    assert told(text, values(ROS1))[0] == ("usual", (), Sure.LIKELY)
    (one,) = alternatives(text, values(ROS1, **{"~t": "given"}))
    assert one.text == parameter("~t")
    declared = choice("a", "b", IsSet(parameter("p", "1")))
    assert told(declared, values())[0][0] == "a"
    assert len(told(choice("a", "b", IsSet(parameter("p"))), values())) == 2


def test_nothing_is_no_name_and_the_same_twice_is_no_choice():
    assert told(choice("a", ""), values()) == [("a", ("c",), Sure.CERTAIN)]
    assert told(choice("a", unknown(NotSet("topic_"))), values()) == [("a", ("c",), Sure.CERTAIN)]
    same = Text.of(choice("a", "b"), "c")
    assert told(Text.of(choice("x", "x")), values()) == [("x", (), Sure.CERTAIN)]
    assert [one[0] for one in told(same, values())] == ["ac", "bc"]


def test_a_global_name_leaves_the_private_namespace():
    assert [one[0] for one in told(Text.of("~/", choice("/a", "b")), values(ROS1))] == ["/a", "~/b"]


def test_too_many_are_left_as_a_hole():
    text = Text.of(*(choice("a", "b", condition=f"c{number}") for number in range(5)))
    (one,) = alternatives(text, values())
    assert one.text == text
    assert values().fill(text).sure is Sure.POSSIBLE
    assert values().fill(text).text.pattern == "*" * 5


def test_a_choice_inside_of_a_text_is_filled():
    text = choice("a", parameter("t"), IsTrue(parameter("p")))
    filled = values(p="false", t="given").fill(text)
    assert (filled.text.known, filled.sure) == ("given", Sure.CERTAIN)
    assert [str(one) for one in filled.how] == ["parameter p, set in a.yaml:1", "parameter t, set in a.yaml:1"]


def test_an_endpoint_keeps_what_was_chosen():
    fact = EndpointFact(
        Role.PUBLISHER, choice("a", "b"), Text.of("m/T"), Evidence("a.cpp", 3), conditions=(Written("x"),)
    )
    first = alternatives(fact.name, values())[0]
    assert as_written(chosen_of(fact, first, first.text).conditions) == ("x", "c")
    plain = EndpointFact(Role.PUBLISHER, Text.of("a"), Text.of("m/T"), Evidence("a.cpp", 3))
    assert chosen_of(plain, alternatives(plain.name, values())[0], Text.of("a")) == plain


HELPER = """
import rospy
from std_msgs.msg import String
def get(name, value):
    private = '~' + name
    if rospy.has_param(private):
        return rospy.get_param(private)
    elif rospy.has_param(name):
        return rospy.get_param(name)
    return value
rospy.init_node('node')
rospy.Publisher(get('topic', 'usual'), String, queue_size=1)
for one in get('topics', ['c']):
    rospy.Publisher(one, String, queue_size=1)
"""


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"/ns/node/topic": "mine"}, "mine"),
        ({"/ns/topic": "ours"}, "ours"),
        ({"/ns/node/topic": "mine", "/ns/topic": "ours"}, "mine"),
        ({}, "usual"),
    ],
)
def test_a_function_that_returns_in_three_places(units, given, name):
    (facts,) = units(a_py=HELPER)
    held = values(ROS1, **given)
    assert [str(held.fill(one.text).text) for one in alternatives(facts.endpoints[0].name, held)] == [name]


def test_each_item_of_what_a_function_returns_in_three_places(units):
    (facts,) = units(a_py=HELPER)
    held = values(ROS1, **{"/ns/node/topics": "[a, b]"})
    found = [str(name) for one in alternatives(facts.endpoints[1].name, held) for name in held.each(one.text)]
    assert found == ["a", "b"]


def test_conditions_that_what_is_set_decides():
    asked = ((Written("on"), IsTrue(parameter("on", "true"))),)
    fact = EndpointFact(
        Role.PUBLISHER,
        Text.of("a"),
        Text.of("m/T"),
        Evidence("a.cpp", 3),
        conditions=(Written("x"), Written("on")),
        asked=asked,
    )
    assert as_written(as_decided(fact, values(on="true")).conditions) == ("x",)
    assert as_decided(fact, values(on="false")) is None
    assert as_decided(fact, values()) == fact
