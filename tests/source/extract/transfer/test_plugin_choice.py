from roslens.source.extract.domain.abstract_value import NodeBuilder
from roslens.source.extract.facts.chosen import Chosen, node_key
from roslens.source.extract.symbolic.text import Hole, Text, unknown
from roslens.source.extract.transfer.plugin_choice import chosen_value

HOST = NodeBuilder("Host", "a.cpp", 3, "ros2", name=Text.of("host"))
INNER = NodeBuilder("Host", "b.hpp", 9, "ros2", name=Text.of("inner"), number=1)
CHOSEN = Chosen((("", "list", "[a, b]"), ("", "one", "x"), ("b.hpp:9:inner", "list", None)))


def test_the_first_node_needs_no_key():
    assert node_key(HOST) == ""
    assert node_key(INNER) == "b.hpp:9:inner"


def test_what_is_set_is_known():
    assert chosen_value(CHOSEN, HOST, "list", None) == [Text.of("a"), Text.of("b")]
    assert chosen_value(CHOSEN, HOST, "one", Text.of("y")) == Text.of("x")


def test_a_default_keeps_its_doubt():
    found = chosen_value(CHOSEN, INNER, "list", Text.of("[c, d]"))
    assert found == [Text((Hole("default of parameter list", default=one),)) for one in "cd"]
    assert chosen_value(CHOSEN, INNER, "list", Text.of("c")).usual == "c"


def test_of_what_is_no_question_nothing_is_said():
    assert chosen_value(CHOSEN, HOST, "other", Text.of("x")) is None
    assert chosen_value(CHOSEN, INNER, "one", Text.of("x")) is None
    assert chosen_value(CHOSEN, INNER, "list", None) is None
    assert chosen_value(CHOSEN, INNER, "list", unknown("why")) is None


def test_a_list_of_maps_is_one_of_their_parts():
    chosen = Chosen((("", "list", "[{name: a, type: 'n::A'}, {name: b, type: 'n::B'}, c]"), ("", "bad", "[{a: ]")))
    first, second, third = chosen_value(chosen, HOST, "list", None)
    assert first == {Text.of("name"): Text.of("a"), Text.of("type"): Text.of("n::A")}
    assert (second[Text.of("type")], third) == (Text.of("n::B"), Text.of("c"))
    assert chosen_value(chosen, HOST, "bad", None) is None
