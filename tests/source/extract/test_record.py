import pytest

from roslens.source.extract.abstract_value import Unknown
from roslens.source.extract.node_facts import Sure
from roslens.source.extract.record import kind_of, sure_of
from roslens.source.extract.text import Text, unknown


@pytest.mark.parametrize(
    ("name", "receiver", "sure"),
    [
        (Text.of("a"), None, Sure.CERTAIN),
        (Text.of("a"), Unknown("whose"), Sure.LIKELY),
        (unknown("parameter t", default="x"), None, Sure.LIKELY),
        (unknown("parameter t"), None, Sure.POSSIBLE),
        (unknown("parameter t"), Unknown("whose"), Sure.POSSIBLE),
    ],
)
def test_how_sure_a_name_is(name, receiver, sure):
    assert sure_of(name, receiver) is sure


def test_types_of_parameters_by_their_defaults():
    values = (True, 1, 1.5, Text.of("a"), [1], None)
    assert [kind_of(one) for one in values] == ["bool", "int", "double", "string", "list", ""]


def test_a_name_that_is_empty_is_not_set(node_of):
    (one,) = node_of('pub_ = create_publisher<std_msgs::msg::String>("", 1);').endpoints
    assert str(one.name) == "{a name that is not set}"
    assert one.evidence.sure is Sure.POSSIBLE


def test_a_parameter_gives_what_was_declared(node_of):
    body = 'declare_parameter("t", "topic");\nstd::string t = get_parameter("t").as_string();\n'
    facts = node_of(body + "pub_ = create_publisher<std_msgs::msg::String>(t, 1);")
    (one,) = facts.endpoints
    assert (one.name.usual, one.name.holes[0].parameter, one.evidence.sure) == ("topic", "t", Sure.LIKELY)
    assert one.evidence.how == "parameter t"
    assert [(str(p.name), p.access, p.type, p.default and p.default.known) for p in facts.parameters] == [
        ("t", "declared", "string", "topic"),
        ("t", "read", "", None),
    ]


def test_a_timer(node_of):
    facts = node_of("timer_ = create_wall_timer(std::chrono::milliseconds(500), [this]() {});")
    assert [one.period_s for one in facts.timers] == [0.5]
