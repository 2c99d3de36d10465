import pytest

from roslens.model.errors import UsageError
from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.catalogue.hints import endpoint_of, hint_of, hinted, text_of
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.settings import NodeHint

HERE = Evidence("roslens.toml", 3)


def read(line: str, role: Role = Role.PUBLISHER, generation: str = "ros2", words=()):
    return endpoint_of(line, role, generation, HERE, words)


def test_a_line_tells_name_type_quality_and_condition():
    one = read("scan sensor_msgs/msg/LaserScan sensor_data if use_laser")
    assert (one.name.known, one.type.known, as_written(one.conditions)) == (
        "scan",
        "sensor_msgs/msg/LaserScan",
        ("use_laser",),
    )
    assert one.qos == Qos("best_effort", "volatile", "keep_last", 5)
    assert read("a std_msgs/msg/String 3").qos == Qos("reliable", "volatile", "keep_last", 3)


def test_without_a_quality_it_is_unknown_with_a_reason():
    one = read("a std_msgs/msg/String")
    assert (one.qos, bool(one.qos_unknown)) == (Qos(), True)


def test_ros1_has_queues_and_latches_and_services_no_quality():
    assert read("a std_msgs/String 3", generation="ros1").queue == 3
    assert read("a std_msgs/String latched", generation="ros1").latched
    assert read("a std_srvs/srv/Empty", Role.SERVICE_SERVER).qos is None


def test_names_may_depend_on_parameters_and_words():
    assert text_of("{topic=scan}/raw") == Text((Hole(OfParameter("topic"), "topic", "scan"), "/raw"))
    assert text_of("{1}_out", (Text.of("in"),)).known == "in_out"
    assert text_of("{2}", (Text.of("in"),)).holes[0].reason == "argument 2 of its command line"
    assert read("{1} *").type.known is None


@pytest.mark.parametrize(
    "line", ["", "scan", "scan LaserScan", "scan a/b/C", "scan a/msg/B 3 4", "scan a/msg/B fast", "scan a/msg/B/C"]
)
def test_other_lines_are_refused(line):
    with pytest.raises(UsageError):
        read(line)


def test_a_hint_is_found_by_node_before_program():
    hints = {"/a": NodeHint(("x a/msg/B",)), "pkg/program": NodeHint((), ("y a/msg/B",))}
    assert hint_of(hints, "/a", "pkg", "program") == ("/a", hints["/a"])
    assert hint_of(hints, "/b", "pkg", "program") == ("pkg/program", hints["pkg/program"])
    assert hint_of(hints, "/b", "pkg", "other") is None
    (one,) = hinted(hints["/a"], "ros2", "roslens.toml", "/a")
    assert (one.role, one.evidence.path) == (Role.PUBLISHER, "roslens.toml")
