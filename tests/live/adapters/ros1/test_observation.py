import itertools
import os
import queue
from concurrent.futures import ThreadPoolExecutor

import pytest

from roslens.live.adapters.ros1.ends import Ends
from roslens.live.adapters.ros1.follow import Follower
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.observation import Observation
from roslens.live.adapters.ros1.parameters import Parameters
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.model.graph import Change

pytestmark = pytest.mark.timed

ME = "/roslens_me"


class Watched:
    def __init__(self, system, ends=None, wait_s=1.0, parameters=None):
        ticks = itertools.count(100)
        resolver = Resolver()
        self.follower = Follower(Master(system.master.uri, ME, resolver), ME, "http://127.0.0.1:9/")
        self.observation = Observation(
            self.follower, ME, resolver, "vm", lambda: float(next(ticks)), ends=ends, wait_s=wait_s,
            parameters=parameters,
        )  # fmt: skip
        self.round = self.observation.round

    def close(self):
        self.follower.leave(lambda text: None)
        self.observation.close()


@pytest.fixture
def watch(request):
    def make(*arguments, **options):
        watched = Watched(*arguments, **options)
        request.addfinalizer(watched.close)
        return watched

    return make


def said(frame):
    return [(event.change, event.entity, event.detail) for event in frame.events]


def names(frame):
    return [node.name for node in frame.graph.nodes]


def test_a_system_is_seen(system, watch):
    talker = system.node("/talker", pid=os.getpid())
    system.node("/listener")
    system.publishers["/chat"] = {"/talker"}
    system.subscribers["/chat"] = {"/listener"}
    system.types["/chat"] = "std_msgs/String"
    talker.links = [[1, "/listener", "o", "TCPROS", "/chat", True, ""]]
    talker.stats = [[["/chat", 0, [[1, 700, 0, True]]]], []]
    watched = watch(system)
    first = watched.round()
    assert names(first) == ["/listener", "/talker"]
    assert first.sender == "vm/ros1"
    assert first.events == []
    assert {(end.node, end.name, end.type) for end in first.graph.endpoints if end.name == "/chat"} == {
        ("/talker", "/chat", "std_msgs/String"),
        ("/listener", "/chat", "std_msgs/String"),
    }
    by_name = {node.name: node for node in first.graph.nodes}
    assert (by_name["/talker"].host, by_name["/talker"].pid, by_name["/talker"].proofs) == ("vm", os.getpid(), ("api",))
    assert by_name["/listener"].pid == 0, "process 1 does not listen there, so the number is of another namespace"
    assert ["process 1" in failure.what for failure in first.failures] == [True]
    talker.stats = [[["/chat", 0, [[1, 700 + 25 * 30, 25, True]]]], []]
    second = watched.round()
    assert second.graph is None
    assert [(t.topic, t.publisher, t.subscriber, t.count, t.bytes) for t in second.tallies] == [
        ("/chat", "/talker", "/listener", 25, 25 * 26)
    ]
    assert second.failures == [], "what was said is not said again"


def test_we_register_and_take_it_back_and_are_not_part_of_the_system(system, watch):
    watched = watch(system)
    frame = watched.round()
    assert system.reported == ["http://127.0.0.1:9/"]
    assert system.subscribers["/rosout"] == {ME}
    assert frame.graph.nodes == ()
    assert frame.graph.endpoints == ()
    watched.follower.leave(lambda text: None)
    assert system.subscribers["/rosout"] == set()


def test_unregistering_and_appearing_are_events(system, watch):
    system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    system.node("/b", pid=os.getpid())
    system.unregister("/a")
    frame = watched.round()
    assert said(frame)[:2] == [
        (Change.VANISHED, "node:/a", "unregistered at the master"),
        (Change.APPEARED, "node:/b", ""),
    ]


def test_a_node_that_died_without_unregistering_vanishes(system, watch):
    node = system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    node.close()
    frame = watched.round()
    assert said(frame)[0] == (Change.VANISHED, "node:/a", "registered, but its API refuses connections")
    assert frame.graph.nodes == ()
    assert "rosnode cleanup" in str(frame.failures[0])
    assert watched.round().failures == []


def test_its_end_is_noticed_between_rounds(system, watch):
    heard = queue.SimpleQueue()
    ends = Ends(heard.put)
    node = system.node("/a", pid=os.getpid())
    watched = watch(system, ends=ends)
    watched.round()
    node.close()
    name = heard.get(timeout=30)
    frame = watched.observation.ended([name])
    assert said(frame)[0][:2] == (Change.VANISHED, "node:/a")
    assert watched.observation.ended([name]) is None
    ends.close()


def test_a_node_that_lives_again_elsewhere_by_the_same_name_is_found(system, watch):
    node = system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    node.close()
    watched.round()
    system.node("/a", pid=os.getpid())
    moved = watched.observation.moved("/rosout", (system.nodes["/a"].uri,))
    assert moved == {"/a"}
    assert watched.observation.moved("/other", ()) == frozenset()
    assert said(watched.round(moved))[0] == (Change.APPEARED, "node:/a", "")


def test_a_node_that_died_just_now_is_looked_up_in_each_round(system, watch):
    node = system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    node.close()
    for _ in range(2):
        watched.round()
    system.node("/a", pid=os.getpid())
    assert said(watched.round())[0] == (Change.APPEARED, "node:/a", "")


def test_no_master_at_all_is_told_and_it_is_found_when_it_comes(system, watch):
    port = system.master.port
    system.master.close()
    watched = watch(system)
    first = watched.round()
    assert first.graph.nodes == ()
    assert "no ROS master" in first.failures[0].what
    assert "roscore" in first.failures[0].advice
    assert watched.round().failures == []
    system.start(port)
    system.node("/a", pid=os.getpid())
    assert names(watched.round()) == ["/a"]


def test_a_master_that_goes_takes_nothing_along_and_comes_back(system, watch):
    system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    port = system.master.port
    system.master.close()
    gone = watched.round()
    assert gone.graph is None
    assert "is gone" in gone.failures[0].what
    assert [event.entity for event in gone.events] == ["host:vm"]
    system.start(port)
    back = watched.round()
    assert "answers again" in back.events[0].detail
    assert len(system.reported) == 1, "the same master still knows us"


def test_a_master_that_was_restarted_is_another_one(system, watch):
    system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    port = system.master.port
    system.master.close()
    watched.round()
    nodes, system.pid = dict(system.nodes), 101
    system.publishers, system.subscribers, system.nodes = {}, {}, {}
    system.start(port)
    frame = watched.round()
    assert "was restarted" in frame.events[0].detail
    assert [event.entity for event in frame.events] == ["host:vm"], "the node runs on"
    (failure,) = frame.failures
    assert failure.what == "the ROS master was restarted and does not know /a, which run on"
    assert len(system.reported) == 2, "we register at the new one"
    graph = watched.observation._graph
    assert [(end.node, end.name) for end in graph.endpoints if end.node == "/a"] == [("/a", "/rosout")]
    system.nodes = nodes
    system.publishers["/rosout"] = {"/a"}
    watched.round()
    assert not watched.observation._orphans.names


def test_a_node_that_ends_after_the_master_was_restarted_is_gone(system, watch):
    system.node("/a", pid=os.getpid())
    watched = watch(system)
    watched.round()
    port, (node, *_) = system.master.port, system.nodes.values()
    system.master.close()
    watched.round()
    system.pid = 101
    system.publishers, system.subscribers, system.nodes = {}, {}, {}
    system.start(port)
    watched.round()
    node.close()
    gone = [event for _ in range(3) for event in watched.round().events if event.change is Change.VANISHED]
    assert "node:/a" in [event.entity for event in gone]
    assert not watched.round().failures


def test_a_node_that_hangs_is_named_and_holds_up_nobody(system, watch, script):
    port = script(lambda line, done: done.wait())
    system.node("/a", pid=os.getpid())
    hung = system.node("/hung")
    hung.uri = f"http://127.0.0.1:{port}/"
    watched = watch(system, wait_s=0.1)
    frame = watched.round()
    assert names(frame) == ["/a", "/hung"]
    (what,) = [failure.what for failure in frame.failures if failure.entity == "node:/hung"]
    assert "does not answer within 0.1 s" in what


@pytest.mark.parametrize("answer", [b"nonsense", [1, "", 7], [[], "x", 5], 5, [1, "", [["/t"], [[]], []]]])
def test_nonsense_of_a_node_is_named_and_the_others_are_seen(system, watch, answer):
    system.node("/a", pid=os.getpid())
    system.node("/mad", pid=os.getpid()).answers["getBusStats"] = answer
    frame = watch(system).round()
    assert names(frame) == ["/a", "/mad"]
    assert frame.failures


@pytest.mark.parametrize("answer", [b"nonsense", [1, "", 7], [1, "", [[], []]], [-1, "no", 0], 5])
def test_nonsense_of_the_master_is_named(system, watch, answer):
    system.master.answers["getSystemState"] = answer
    frame = watch(system).round()
    assert "no ROS master" in frame.failures[0].what


def test_parameters_stand_with_the_nodes_and_their_changes_are_events(system, watch):
    system.node("/talker")
    tree = {"rate": 10, "talker": {"gain": 0.5, "api_key": "hunter2"}}
    system.master.answers["subscribeParam"] = lambda caller, api, key: [1, "", tree]
    system.master.answers["unsubscribeParam"] = [1, "", 1]
    reads = ThreadPoolExecutor(1)
    master = Master(system.master.uri, ME, Resolver())
    asked = []
    parameters = Parameters(
        master, "http://127.0.0.1:9/", lambda: 0.0, lambda call: asked.append(reads.submit(call)) or asked[-1]
    )
    watched = watch(system, parameters=parameters)
    first = watched.round()
    asked[0].result()
    reported = first if first.graph.parameters else watched.round()
    assert reported.graph.parameters == {"": {"/rate": "10"}, "/talker": {"gain": "0.5", "api_key": "***"}}
    parameters.note("/rate/", 20)
    changed = watched.round()
    assert said(changed) == [(Change.CHANGED, "parameter:/rate", "10 is now 20")]
    assert changed.graph is None
    later = [frame.graph for _ in range(5) if (frame := watched.round()).graph]
    assert [graph.parameters[""]["/rate"] for graph in later] == ["20"]
    system.node("/other")
    assert watched.round().graph.parameters[""] == {"/rate": "20"}
    parameters.leave(pytest.fail)
    assert system.master.calls[-1][0] == "unsubscribeParam"
    master.close()
