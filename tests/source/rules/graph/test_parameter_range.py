import pytest

from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_range import found, number_of
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node, parameter


def findings(range_="", *, value, kind="double", given=None, default=False, generation="ros2", **more):
    one = parameter(
        "rate",
        type=kind,
        set_type="" if default else given or kind,
        value=value,
        access="declared",
        range=range_,
        proof=Proof("src/a.cpp", 5, **more.pop("proof", {})),
        set_by=None if default else launched(3, "a.yaml"),
        **more,
    )
    return list(found(configuration(node("/a", parameters=(one,)), generation=generation), Surroundings()))


def test_a_value_outside_of_the_range_stops_a_node_of_ros2():
    (one,) = findings("0.0..10.0", value="30.0")
    assert (one.severity, one.path, one.line) == (Severity.ERROR, "a.yaml", 3)
    assert one.message == (
        "parameter `rate` of /a is set to `30.0`; src/a.cpp:5 allows `0.0..10.0`: the node does not start."
    )


def test_a_default_outside_of_the_range_is_told_where_it_is_declared():
    (one,) = findings("1..5", value="50", kind="int", default=True)
    assert (one.path, one.line) == ("src/a.cpp", 5)
    assert one.message.startswith("parameter `rate` of /a is by default `50`; its declaration allows `1..5`")


@pytest.mark.parametrize(
    ("range_", "value", "kind", "broken"),
    [
        ("0.0..1.0", "1.0", "double", False),
        ("0.0..<1.0", "1.0", "double", True),
        (">0.0..", "0.0", "double", True),
        (">0.0..", "1e-3", "double", False),
        ("..5", "6", "int", True),
        ("..5", "-6", "int", False),
        ("0..0x10", "0x11", "int", True),
        ("0.0..1.0", "nan", "double", False),
        ("0.0..1.0", "what", "double", False),
        ("odd", "5", "int", False),
        ("0..1", "5", "string", False),
    ],
)
def test_ranges(range_, value, kind, broken):
    assert bool(findings(range_, value=value, kind=kind)) is broken


def test_values_that_are_allowed():
    (one,) = findings(value="medium", kind="string", allowed=("fast", "slow"))
    assert "allows one of `fast`, `slow`: the node does not start" in one.message
    assert not findings(value="fast", kind="string", allowed=("fast", "slow"))
    assert not findings(value="0x2", kind="int", allowed=("1", "2"))
    assert findings(value="3", kind="int", allowed=("1", "2"))


def test_a_value_of_another_type_is_for_another_rule():
    assert not findings("0.0..1.0", value="5", given="int")
    assert not findings("0.0..1.0", value=None)


def test_dynamic_reconfigure_takes_the_nearest_end():
    (one,) = findings("0..1", value="5", kind="int", generation="ros1")
    assert (one.severity, "the nearest end is used" in one.message) == (Severity.WARNING, True)


def test_what_is_set_is_told_though_a_server_makes_another_number_of_it():
    (told,) = findings("0.0..9.0", value="9.0", given="int", set_value="12", generation="ros1")
    assert "is set to `12`; src/a.cpp:5 allows `0.0..9.0`: the nearest end is used." in told.message


def test_what_is_not_certain_weighs_less():
    (one,) = findings("0..1", value="5", kind="int", proof={"sure": "likely", "how": "a default"})
    assert (one.severity, "In doubt: likely only: a default" in one.message) == (Severity.WARNING, True)


@pytest.mark.parametrize(("text", "number"), [("0x10", 16), ("-1e3", -1000), (".5", 0.5), ("", None), ("a", None)])
def test_numbers(text, number):
    assert number_of(text) == number
