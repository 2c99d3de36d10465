import pytest

from roslens.live.join.gid_places import GidPlaces
from roslens.model.graph import Endpoint, Graph, Process, Role

CONTEXT = "010faaaa0900000000000000"


def graph(*processes, identities=(), gid=CONTEXT + "00001203"):
    ends = (Endpoint("/lidar", Role.PUBLISHER, "/scan", gid=gid),)
    return Graph("ros2", endpoints=ends, processes=processes, identities=dict(identities))


@pytest.mark.parametrize(
    ("whole", "expected"),
    [
        (graph(), ("", 0, ())),
        (graph(Process("a", 9)), ("a", 9, ("processes",))),
        (graph(Process("a", 9, nodes=("/lidar",))), ("a", 9, ("counters",))),
        (graph(Process("a", 9), identities={"a": ("aaaa",)}), ("a", 9, ("address",))),
        (graph(Process("a", 9, nodes=("/lidar",)), identities={"a": ("aaaa",)}), ("a", 9, ("counters", "address"))),
        (graph(Process("a", 7), identities={"a": ("aaaa",)}), ("a", 0, ("address",))),
        (graph(Process("a", 9, nodes=("/other",)), Process("b", 9)), ("", 0, ())),
        (graph(Process("a", 9, nodes=("/lidar",)), Process("b", 9, nodes=("/lidar",))), ("", 0, ())),
        (graph(Process("a", 9), Process("a", 9 + 65536), identities={"a": ("aaaa",)}), ("a", 0, ("address",))),
        (graph(identities={"a": ("aaaa",), "b": ("aaaa",)}), ("", 0, ())),
    ],
)
def test_what_shows_the_place_of_a_context(whole, expected):
    assert GidPlaces(whole, {}, {}).of(CONTEXT) == expected


def test_proofs_that_disagree_show_no_bits():
    whole = graph(Process("a", 9, nodes=("/lidar",)), identities={"b": ("aaaa",)})
    found = GidPlaces(whole, {}, {})
    assert found.of(CONTEXT) == ("a", 9, ("counters",))
    assert found.of("010faaaa0800000000000000") == ("", 0, ())


def test_who_was_sure_is_so_until_somebody_else_is():
    sure = {CONTEXT: ("a", 9)}
    assert GidPlaces(graph(), {}, sure).of(CONTEXT) == ("a", 9, ("counters",))
    assert GidPlaces(graph(Process("b", 9, nodes=("/lidar",))), {}, sure).of(CONTEXT) == ("b", 9, ("counters",))


def test_processes_that_ended_were_of_their_host():
    assert GidPlaces(graph(), {}, {}, ["a/9"]).of(CONTEXT) == ("a", 0, ("processes",))


@pytest.mark.parametrize("gid", ["", "010f", "0110aaaa0900000000000000"])
def test_identifiers_of_other_middlewares_have_no_context(gid):
    assert GidPlaces(graph(gid=gid), {}, {}).nodes_of == {}
