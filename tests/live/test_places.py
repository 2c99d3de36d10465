import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.join.places import Places
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


FAR = ("/map", "bbbb", 65536 + 40)


def test_without_better_proofs_nodes_are_where_all_processes_seen_with_their_bits_are():
    alone = (*THERE[:2], ("brain", 65536 + 40))
    placed = Places().place(graph(LIDAR, CAMERA, FAR, processes=alone))
    assert found(placed) == {"/lidar": ("sensor", 300), "/camera": ("sensor", 9), "/map": ("brain", 65576)}
    assert {node.proofs for node in placed.nodes} == {("processes",)}


def test_what_two_hosts_could_be_is_neither():
    placed = Places().place(graph(PLANNER, processes=THERE))
    assert found(placed) == {"/planner": ("", 0)}


def test_a_host_that_two_could_be_is_neither():
    placed = Places().place(graph(LIDAR, CAMERA, PLANNER, processes=THERE))
    assert set(found(placed).values()) == {("", 0)}


def test_one_process_among_several_shows_no_host():
    assert found(Places().place(graph(PLANNER, processes=THERE[:2]))) == {"/planner": ("", 0)}


def test_a_host_is_found_anew_when_more_is_known():
    places = Places()
    alone = [("sensor", 9)]
    assert found(places.place(graph(PLANNER, processes=alone))) == {"/planner": ("sensor", 9)}
    both = [("sensor", 9), ("brain", 9)]
    assert found(places.place(graph(PLANNER, processes=both))) == {"/planner": ("", 0)}
    known = evident(PLANNER, processes=both, identities=[("brain", "bbbb")])
    assert found(places.place(known)) == {"/planner": ("brain", 9)}


def test_the_host_of_the_observer_is_taken_already():
    placed = Places().place(graph(LIDAR, PLANNER, processes=(("base", 300), ("base", 9), ("arm", 9)),
                                  local=[("/lidar", "base", 300)]))  # fmt: skip
    assert found(placed) == {"/lidar": ("base", 300), "/planner": ("arm", 9)}


def evident(*of, processes=(), counting=(), identities=()):
    """A graph of nodes, processes, who counts in which, and what identifiers of hosts have."""
    names = {}
    for node, host, pid in counting:
        names.setdefault((host, pid), []).append(node)
    made = tuple(Process(*one, nodes=tuple(names.get(one, ()))) for one in processes)
    whole = graph(*of)
    return msgspec.structs.replace(whole, processes=made, identities={host: tuple(bits) for host, *bits in identities})


SAME_PIDS = [("sensor", 9), ("brain", 9)]


def test_whose_process_counts_says_where_it_is():
    counting = [("/camera", "sensor", 9), ("/planner", "brain", 9)]
    placed = Places().place(evident(CAMERA, PLANNER, processes=SAME_PIDS, counting=counting))
    assert found(placed) == {"/camera": ("sensor", 9), "/planner": ("brain", 9)}
    assert {node.proofs for node in placed.nodes} == {("counters",)}


def test_a_host_is_known_by_its_addresses():
    whole = evident(CAMERA, PLANNER, processes=SAME_PIDS, identities=[("sensor", "0000", "aaaa"), ("brain", "bbbb")])
    placed = Places().place(whole)
    assert found(placed) == {"/camera": ("sensor", 9), "/planner": ("brain", 9)}
    assert {node.proofs for node in placed.nodes} == {("address",)}


def test_two_hosts_of_the_same_addresses_are_told_apart_by_what_counts():
    other = ("/planner", "aaaa", 9)
    whole = evident(LIDAR, other, processes=[("sensor", 300), *SAME_PIDS], counting=[("/planner", "brain", 9)],
                    identities=[("sensor", "aaaa"), ("brain", "aaaa")])  # fmt: skip
    assert found(Places().place(whole)) == {"/lidar": ("", 0), "/planner": ("brain", 9)}


def test_nodes_that_do_not_count_are_where_one_with_the_same_bits_does():
    whole = evident(LIDAR, CAMERA, processes=[("sensor", 300), *SAME_PIDS], counting=[("/lidar", "sensor", 300)])
    placed = Places().place(whole)
    assert found(placed) == {"/lidar": ("sensor", 300), "/camera": ("sensor", 9)}
    assert [node.proofs for node in placed.nodes] == [("counters",), ("gid",)]


def test_a_host_whose_addresses_are_known_is_no_guess_for_other_bits():
    whole = evident(PLANNER, processes=[("sensor", 9)], identities=[("sensor", "aaaa")])
    assert found(Places().place(whole)) == {"/planner": ("", 0)}


def test_nodes_of_one_process_share_what_is_known_of_it():
    whole = evident(LIDAR, ("/filter", "aaaa", 300), processes=THERE, counting=[("/filter", "sensor", 300)])
    assert found(Places().place(whole)) == {"/lidar": ("sensor", 300), "/filter": ("sensor", 300)}


def test_a_process_in_a_container_is_known_by_the_id_it_sees():
    whole = msgspec.structs.replace(
        graph(CAMERA), processes=(Process("sensor", 4000, inner=9),), identities={"sensor": ("aaaa",)}
    )
    assert found(Places().place(whole)) == {"/camera": ("sensor", 4000)}


def test_where_a_process_counted_is_known_after_it_ended():
    places = Places()
    places.place(evident(CAMERA, PLANNER, processes=SAME_PIDS, counting=[("/camera", "sensor", 9)]))
    places.happened([Event(1.0, Change.VANISHED, "process:sensor/9")])
    placed = places.place(evident(CAMERA, PLANNER, processes=[("brain", 9)]))
    assert "/camera" not in found(placed)
    assert "/planner" in found(placed)


HOSTS = st.sampled_from(["sensor", "brain", "arm"])
BITS = {"sensor": "aaaa", "brain": "bbbb", "arm": "cccc"}


@given(
    st.lists(st.tuples(HOSTS, st.integers(10, 14)), min_size=1, max_size=9, unique=True),
    st.sets(HOSTS),
    st.sets(HOSTS),
    st.sets(HOSTS),
)
def test_a_place_is_true_or_unknown_however_pids_collide(processes, agents, counting, addresses):
    """With agents that tell their addresses or what counts; whatever is not reported, nothing wrong is said."""
    of = [(f"/n{at}", BITS[host], pid) for at, (host, pid) in enumerate(processes)]
    reported = [(host, pid) for host, pid in processes if host in agents]
    counted = [(f"/n{at}", host, pid) for at, (host, pid) in enumerate(processes) if host in agents & counting]
    known = addresses | (agents - counting)
    whole = evident(
        *of, processes=reported, counting=counted, identities=[(host, BITS[host]) for host in known & agents]
    )
    placed = found(Places().place(whole))
    for at, (host, pid) in enumerate(processes):
        expected = {("", 0), (host, 0), (host, pid)} if host not in agents else {(host, pid)}
        assert placed[f"/n{at}"] in expected


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
