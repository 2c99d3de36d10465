import msgspec
import pytest

from roslens.live.join.gid_names import KEPT_S, MOST_WAITING, WAIT_S, GidNames
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.traffic.tally import BY_GID, Tally

GID = "010faaaa09000000000000000000120" + "3"


def graph(*of):
    return Graph("ros2", endpoints=tuple(Endpoint(node, role, "/scan", gid=gid) for node, role, gid in of))


LIDAR = ("/lidar", Role.PUBLISHER, GID)
PLANNER = ("/planner", Role.SUBSCRIPTION, "010fbbbb")


def tally(count=1, publisher=BY_GID + GID, lost=0):
    return Tally("/scan", publisher, "/planner", 0.0, 1.0, count, lost=lost)


@pytest.fixture
def names():
    return GidNames()


def test_a_publisher_of_the_graph_has_its_name(names):
    names.take_graph(graph(LIDAR, PLANNER), 0.0)
    assert names.named(tally(), 0.0).publisher == "/lidar"
    assert names.due(0.0) == []


def test_who_is_not_in_the_graph_yet_is_waited_for(names):
    assert names.named(tally(), 0.0) is None
    assert names.due(1.0) == []
    names.take_graph(graph(LIDAR, PLANNER), 1.0)
    assert [one.publisher for one in names.due(1.0)] == ["/lidar"]
    assert names.due(WAIT_S) == []


def test_who_never_comes_has_no_name_and_never_an_identifier_for_one(names):
    assert names.named(tally(), 0.0) is None
    assert [one.publisher for one in names.due(WAIT_S)] == [""]


def test_a_clock_that_went_back_keeps_nobody_waiting(names):
    names.named(tally(), 100.0)
    assert [one.publisher for one in names.due(1.0)] == [""]


def test_last_words_of_who_left_are_told_under_the_name(names):
    names.take_graph(graph(LIDAR, PLANNER), 0.0)
    names.take_graph(graph(PLANNER), 1.0)
    assert names.named(tally(), 2.0).publisher == "/lidar"
    names.take_graph(graph(PLANNER), KEPT_S + 1.0)
    assert names.named(tally(), KEPT_S + 1.0) is None


def test_silence_of_what_was_taken_apart_is_no_news(names):
    names.take_graph(graph(LIDAR, PLANNER), 0.0)
    assert names.named(tally(0), 0.0) is not None
    names.take_graph(graph(LIDAR), 0.0)
    assert names.named(tally(0), 0.0) is None
    assert names.named(tally(0, BY_GID + "00"), 0.0) is None
    assert names.due(WAIT_S) == []


def test_what_waits_is_bounded(names):
    for _ in range(MOST_WAITING + 10):
        names.named(tally(), 0.0)
    assert len(names.due(WAIT_S)) == MOST_WAITING


def test_names_are_taken_as_they_are(names):
    assert names.named(tally(publisher="/lidar"), 0.0).publisher == "/lidar"


def test_nodes_of_another_domain_are_told_to_nobody(names):
    names.take_graph(graph(LIDAR, PLANNER), 0.0)
    other = msgspec.structs.replace(tally(publisher=BY_GID + "010fcccc"), subscriber="/elsewhere")
    assert names.named(other, 0.0) is None
    assert names.named(msgspec.structs.replace(other, publisher="/elsewhere", subscriber=""), 0.0) is None
    assert names.due(WAIT_S) == []


def test_without_a_graph_nodes_are_known_by_their_own_word(names):
    assert names.named(tally(publisher="/lidar"), 0.0).publisher == "/lidar"
