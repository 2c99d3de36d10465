from accuracy.comparing import IMPLICIT, Row, compare, silent_nodes, total
from accuracy.facts import NODE, PARAMETER, Fact
from accuracy.system import Reason
from roslens.model.graph import Graph, Node

TOPIC = Fact("publisher", "/n", "/t", {"type": "a/B", "reliability": "reliable"})


def told(**changes):
    return Fact(**{"kind": "publisher", "node": "/n", "name": "/t", "values": {"type": "a/B"}, **changes})


def test_what_both_have_is_found_and_right():
    found = compare([TOPIC], [told()], (), "ros2")
    assert found.rows["publisher"] == Row(seen=1, found=1, said=1, right=1)
    assert found.rows["types"] == Row(seen=1, found=1, said=1, right=1)
    assert found.rows["QoS"] == Row(seen=1), "it says nothing of it"


def test_what_source_does_not_say_is_missed_and_wants_a_reason():
    found = compare([TOPIC], [], (), "ros2")
    assert found.rows["publisher"] == Row(seen=1)
    assert [one.what for one in found.unexplained] == ["missed"]
    why = Reason("unresolved", "The name comes from a file.", ("publisher /n /t*",))
    assert compare([TOPIC], [], (why,), "ros2").unexplained == []


def test_what_cannot_be_resolved_is_counted_aside():
    why = Reason("run-time only", "A message names it.", ("publisher * /t",))
    assert compare([TOPIC], [], (why,), "ros2").rows["publisher"] == Row(aside=1)


def test_a_name_with_a_hole_is_no_answer_but_is_told():
    found = compare([TOPIC], [told(name="/*", resolved=False, given="{parameter x}")], (), "ros2")
    assert found.rows["publisher"] == Row(seen=1)
    assert "{parameter x}" in found.differences[0].text


def test_what_is_said_and_not_there_is_wrong_where_source_is_certain():
    found = compare([], [told(), told(name="/u", sure="likely"), told(name="/v", conditions=("x",))], (), "ros2")
    assert found.rows["publisher"] == Row(said=2, wrong=1, conditional=1)
    assert [one.fact.name for one in found.wrong] == ["/t"]
    assert [one.what for one in found.unexplained] == ["extra", "extra"]


def test_nothing_can_be_said_of_clients_of_ros1():
    assert compare([], [told(kind="service_client")], (), "ros1").differences == []


def test_another_value_is_wrong_where_source_is_certain():
    found = compare([TOPIC], [told(values={"type": "a/C"})], (), "ros2")
    assert found.rows["types"] == Row(seen=1, said=1, wrong=1)
    assert [one.what for one in found.wrong] == ["other value"]
    found = compare([TOPIC], [told(values={"type": "a/C"}, sure="likely")], (), "ros2")
    assert found.wrong == []


def test_a_node_with_a_random_end_is_known_by_its_beginning():
    shown = [Fact(NODE, "/n_17"), Fact("service_server", "/n_17", "/n_17/x"), Fact(NODE, "/other")]
    said = [Fact(NODE, "/n_*"), Fact("service_server", "/n_*", "/n_*/x")]
    found = compare(shown, said, (), "ros1")
    assert found.rows["service_server"].right == 1
    assert [one.fact.node for one in found.unexplained] == ["/other"]


def test_what_every_node_has_does_not_lift_the_rest():
    rosout = Fact("publisher", "/n", "/rosout")
    assert compare([rosout], [], (), "ros1").rows == {IMPLICIT: Row(seen=1)}
    assert compare([rosout], [Fact("publisher", "/n", "/rosout", implicit=True)], (), "ros1").rows[IMPLICIT].right == 1


def test_parameters_of_a_node_that_tells_none_are_not_compared():
    graph = Graph("ros2", (Node("/n"), Node("/m")), parameters={"/m": {}})
    silent = silent_nodes(graph)
    assert silent == {"/n"}
    assert compare([], [Fact(PARAMETER, "/n", "x")], (), "ros2", silent).differences == []


def test_rows_of_systems_add_up_in_their_order():
    sums = total([{"types": Row(1, 1)}, {"types": Row(2), "node": Row(3)}])
    assert list(sums) == ["node", "types"]
    assert sums["types"] == Row(3, 1)


def test_numbers_are_compared_as_numbers_of_their_type():
    def found(says, is_so):
        shown = Fact(PARAMETER, "/n", "x", {"value": is_so})
        return compare([shown], [Fact(PARAMETER, "/n", "x", {"value": says})], (), "ros2").differences

    assert not found("0.10", "0.1")
    assert found("1", "1.0")
    assert found("a.b", "a.c")
