"""Tools of topic_tools and commands of ros2: their words and parameters say what they make."""

import pytest

from roslens.model.graph import Role
from roslens.source.extract.catalogue.catalogue import known_node
from roslens.source.extract.configuration.assemble import assemble
from roslens.source.extract.configuration.assemble_units import KnownUnits
from roslens.source.extract.facts.launched import Launch, Launched, Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text, unknown

START = Evidence("a/launch/a.launch", 3)


def node(package, tool, generation, *words, plugin="", **values):
    settings = tuple(Setting(Text.of(name), Text.of(value), START) for name, value in values.items())
    started = Launched(
        Text.of(package), Text() if plugin else Text.of(tool), START, Text.of("me"), settings=settings,
        arguments=tuple(Text.of(one) if isinstance(one, str) else one for one in words),
        plugin=Text.of(plugin), kind="component" if plugin else "node",
    )  # fmt: skip
    (one,) = assemble(Launch(generation, (started,)), KnownUnits({}, ()), title="t", known=known_node).nodes
    return one


def told(found):
    ends = [one for one in found.endpoints if not one.implicit]
    letters = {Role.PUBLISHER: "pub", Role.SUBSCRIPTION: "sub", Role.SERVICE_SERVER: "serve",
               Role.SERVICE_CLIENT: "call", Role.ACTION_CLIENT: "do"}  # fmt: skip
    return {f"{letters[one.endpoint.role]} {one.endpoint.name} {one.endpoint.type}".strip(): one for one in ends}


@pytest.mark.parametrize(
    ("tool", "words", "target"),
    [
        ("relay", ("/in",), "/in_relay"),
        ("relay", ("/in", "/out"), "/out"),
        ("throttle", ("messages", "/in", "5"), "/in_throttle"),
        ("throttle", ("messages", "/in", "5", "/out"), "/out"),
        ("throttle", ("bytes", "/in", "5", "2"), "/in_throttle"),
        ("throttle", ("bytes", "/in", "5", "2", "/out"), "/out"),
        ("drop", ("/in", "1", "2"), "/in_drop"),
        ("drop", ("/in", "1", "2", "/out"), "/out"),
    ],
)
def test_what_passes_one_topic_on_publishes_when_a_message_has_come(tool, words, target):
    ends = told(node("topic_tools", tool, "ros1", *words))
    assert set(ends) == {"sub /in", f"pub {target}"}
    assert as_written(ends["sub /in"].conditions) == ()
    assert as_written(ends[f"pub {target}"].conditions) == ("a message on /in has been received",)
    assert {one.proof.how for one in ends.values()} == {"known for this tool; differs between releases"}


def test_a_mux_has_services_and_tells_what_is_selected():
    ends = told(node("topic_tools", "mux", "ros1", "/out", "/a", "/b"))
    kinds = {f"serve /mux/{one} topic_tools/Mux{one.capitalize()}" for one in ("select", "add", "delete", "list")}
    assert set(ends) == kinds | {
        "sub /a", "sub /b", "pub /out", "pub /mux/selected std_msgs/String", "serve /out_select topic_tools/MuxSelect",
    }  # fmt: skip
    assert ends["pub /mux/selected std_msgs/String"].latched
    assert as_written(ends["pub /out"].conditions) == ("a message on the selected topic has been received",)


def test_a_demux_publishes_what_is_selected():
    ends = told(node("topic_tools", "demux", "ros1", "/in", "/a", "/b"))
    assert {"sub /in", "pub /a", "pub /b", "serve /demux/add topic_tools/DemuxAdd"} < set(ends)
    assert as_written(ends["pub /a"].conditions) == ("a message on /in has been received",)
    assert as_written(ends["pub /b"].conditions) == ("a message on /in has been received", "it is selected")


@pytest.mark.parametrize("tool", ["transform", "relay_field"])
def test_what_is_converted_may_be_a_field(tool):
    words = ("/imu/orientation", "/norm", "std_msgs/Float64", "m.x", "--latch")
    found = node("topic_tools", tool, "ros1", *words)
    ends = told(found)
    assert set(ends) == {"sub *", "pub /norm std_msgs/Float64"}
    assert ends["pub /norm std_msgs/Float64"].latched
    assert not ends["sub *"].resolved
    assert "pub /norm std_msgs/msg/Float64" in told(node("topic_tools", tool, "ros2", *words))


def test_words_that_are_missing_are_unknown():
    ends = told(node("topic_tools", "relay", "ros1", unknown("argument in")))
    assert set(ends) == {"sub *", "pub *_relay"}
    assert set(told(node("topic_tools", "mux", "ros1"))) > {"sub *", "pub *"}


@pytest.mark.parametrize(
    ("words", "expected", "latched"),
    [
        (("pub", "/x", "std_msgs/String", "data: a"), "pub /x std_msgs/String", True),
        (("pub", "-r", "10", "/x", "std_msgs/String"), "pub /x std_msgs/String", False),
        (("pub", "-1", "/x", "std_msgs/Float64", "-3.0"), "pub /x std_msgs/Float64", True),
        (("echo", "-n", "1", "/x"), "sub /x", False),
    ],
)
def test_rostopic_publishes_and_subscribes(words, expected, latched):
    ends = told(node("rostopic", "rostopic", "ros1", *words))
    assert set(ends) == {expected}
    assert ends[expected].latched is latched


@pytest.mark.parametrize("tool", ["relay", "throttle", "drop", "delay"])
def test_tools_of_ros2_wait_for_somebody_who_publishes(tool):
    ends = told(node("topic_tools", tool, "ros2", input_topic="in"))
    assert set(ends) == {"sub /in", f"pub /in_{tool}"}
    assert {as_written(one.conditions) for one in ends.values()} == {("in is published",)}
    assert "pub /out" in told(node("topic_tools", tool, "ros2", input_topic="/in", output_topic="/out"))
    assert set(told(node("topic_tools", tool, "ros2"))) == {"sub *", f"pub *_{tool}"}


def test_a_mux_of_ros2_takes_one_topic_at_a_time():
    ends = told(node("topic_tools", "mux", "ros2", input_topics="[/a, /b]"))
    assert {"sub /a", "pub /me/selected", "serve /me/add topic_tools_interfaces/srv/MuxAdd"} < set(ends)
    assert "sub /b" not in ends
    other = told(node("topic_tools", "mux", "ros2", input_topics="[/a, /b]", initial_topic="/b", output_topic="/out"))
    assert {"sub /b", "pub /out"} < set(other)
    none = told(node("topic_tools", "mux", "ros2", input_topics="[/a]", initial_topic="__none"))
    assert {one.split()[0] for one in none} == {"serve"}


def test_a_demux_of_ros2_publishes_one_topic_at_a_time():
    ends = told(node("topic_tools", "demux", "ros2", output_topics="[/a, /b]", input_topic="/in"))
    assert {"sub /in", "pub /a", "serve /me/select topic_tools_interfaces/srv/DemuxSelect"} < set(ends)
    assert "pub /b" not in ends


def test_a_tool_is_a_component_too():
    ends = told(node("topic_tools", "", "ros2", plugin="topic_tools::RelayNode", input_topic="/in"))
    assert set(ends) == {"sub /in", "pub /in_relay"}
