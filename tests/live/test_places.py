import pytest

from roslens.live.places import Places
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role


def gid(bits, pid, number=0):
    return f"010f{bits}{pid & 255:02x}{pid >> 8 & 255:02x}{number:04x}0000000000001203"


def ends(*of):
    return tuple(Endpoint(node, Role.PUBLISHER, f"/of{node}", gid=gid(bits, pid)) for node, bits, pid in of)


def graph(*of, processes=(), local=()):
    nodes = tuple(Node(node, *next((place for name, *place in local if name == node), ())) for node, _, _ in of)
    return Graph("ros2", nodes, ends(*of), processes=tuple(Process(*one) for one in processes))


def found(placed):
    return {node.name: (node.host, node.pid) for node in placed.nodes}


LIDAR, CAMERA, PLANNER = ("/lidar", "aaaa", 300), ("/camera", "aaaa", 9), ("/planner", "bbbb", 9)
THERE = (("sensor", 300), ("sensor", 9), ("brain", 9), ("brain", 65536 + 40))


def test_nodes_are_where_all_processes_seen_with_their_bits_are():
    placed = Places().place(graph(LIDAR, CAMERA, PLANNER, processes=THERE))
    assert found(placed) == {"/lidar": ("sensor", 300), "/camera": ("sensor", 9), "/planner": ("brain", 9)}


def test_what_two_hosts_could_be_is_neither():
    placed = Places().place(graph(PLANNER, processes=THERE))
    assert found(placed) == {"/planner": ("", 0)}


def test_only_the_low_bits_of_a_process_are_known():
    placed = Places().place(graph(("/map", "cccc", 65536 + 40), processes=THERE))
    assert found(placed) == {"/map": ("brain", 65576)}


def test_the_host_of_the_observer_is_taken_already():
    placed = Places().place(graph(LIDAR, PLANNER, processes=(("base", 300), ("base", 9), ("arm", 9)),
                                  local=[("/lidar", "base", 300)]))  # fmt: skip
    assert found(placed) == {"/lidar": ("base", 300), "/planner": ("arm", 9)}


@pytest.mark.parametrize("end", ["", "010f", "0110aaaa2c01000000000000"])
def test_identifiers_of_other_middlewares_tell_nothing(end):
    whole = Graph("ros2", (Node("/a"),), (Endpoint("/a", Role.PUBLISHER, "/x", gid=end),),
                  processes=(Process("sensor", 300),))  # fmt: skip
    assert Places().place(whole) == whole


def test_a_node_whose_process_ended_is_gone_and_comes_back_with_another():
    places = Places()
    places.place(graph(LIDAR, CAMERA, processes=THERE))
    assert places.happened([Event(1.0, Change.VANISHED, "process:sensor/300")])
    placed = places.place(graph(LIDAR, CAMERA, processes=THERE[1:]))
    assert found(placed) == {"/camera": ("sensor", 9)}
    assert {end.node for end in placed.endpoints} == {"/camera"}
    again = Graph("ros2", (*placed.nodes, Node("/lidar")), ends(LIDAR, CAMERA, ("/lidar", "aaaa", 301)))
    assert found(places.place(again)) == {"/camera": ("sensor", 9), "/lidar": ("sensor", 0)}


def test_events_of_other_things_are_none_of_processes():
    assert not Places().happened(
        [Event(1.0, Change.VANISHED, "node:/a"), Event(1.0, Change.APPEARED, "process:base/7")]
    )


def test_a_host_that_is_known_by_its_address_gets_its_name():
    places = Places()
    whole = Graph("ros1", (Node("/a", "10.0.0.2", 7), Node("/b", "base", 8)), hosts=("10.0.0.2", "base"))
    assert places.place(whole) == whole
    assert places.know({"10.0.0.2": "sensor"})
    assert not places.know({"10.0.0.2": "sensor"})
    placed = places.place(whole)
    assert found(placed) == {"/a": ("sensor", 7), "/b": ("base", 8)}
    assert placed.hosts == ("base", "sensor")
    places.happened([Event(1.0, Change.VANISHED, "process:sensor/7")])
    assert found(places.place(whole)) == {"/b": ("base", 8)}
