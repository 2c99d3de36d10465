from types import SimpleNamespace

from roslens.live.adapters.ros2.graph import GraphReader
from roslens.live.adapters.ros2.local_process import Found
from roslens.live.adapters.ros2.observation import Observation
from roslens.live.inside import slots
from roslens.live.inside.counters import Called
from roslens.live.inside.counters import Counted as CountedSlot
from roslens.model.graph import Change, Role
from roslens.model.traffic.tally import Tally

HERE = "78fd"


def gid(pid, number=0, host=HERE):
    return bytes.fromhex(f"010f{host}") + pid.to_bytes(2, "little") + bytes([0] * 9 + [number])


def policy(name):
    return SimpleNamespace(name=name)


FOREVER = SimpleNamespace(nanoseconds=2**63 - 1)
QOS = SimpleNamespace(
    reliability=policy("RELIABLE"), durability=policy("VOLATILE"), history=policy("UNKNOWN"), depth=0,
    deadline=FOREVER, lifespan=FOREVER, liveliness=policy("AUTOMATIC"),
    liveliness_lease_duration=SimpleNamespace(nanoseconds=500_000_000),
)  # fmt: skip


class FakeNode:
    """Lists what a test puts in; ``asked`` are the topics whose endpoints were asked for."""

    def __init__(self):
        self.ends = [("_roslens_1", "/", "p", "/parameter_events", "rcl/msg/E", gid(99))]
        self.asked = []

    def add(self, name, kind, topic, pid, type_name="a/msg/B", host=HERE):
        self.ends.append((name, "/ns", kind, topic, type_name, gid(pid, len(self.ends), host)))

    def get_node_names_and_namespaces(self):
        pids = {(name, space, bytes(number)[:6]) for name, space, *_, number in self.ends}
        return [(name, space) for name, space, _ in sorted(pids)]

    def _by(self, kind, name, space):
        found = {}
        for one, where, what, topic, type_name, _ in self.ends:
            if (one, where, what) == (name, space, kind):
                found.setdefault(topic, [type_name])
        return list(found.items())

    def get_publisher_names_and_types_by_node(self, name, space):
        return self._by("p", name, space)

    def get_subscriber_names_and_types_by_node(self, name, space):
        return self._by("s", name, space)

    def get_service_names_and_types_by_node(self, name, space):
        return self._by("service", name, space)

    def get_client_names_and_types_by_node(self, name, space):
        if name == "leaving":
            raise RuntimeError("no such node")
        return self._by("client", name, space)

    def _info(self, kind, topic):
        return [
            SimpleNamespace(
                node_name=name,
                node_namespace=space,
                topic_type=type_name,
                topic_type_hash="INVALID",
                endpoint_gid=list(number),
                qos_profile=QOS,
            )
            for name, space, what, where, type_name, number in self.ends
            if (what, where) == (kind, topic)
        ]

    def get_publishers_info_by_topic(self, topic):
        self.asked.append(topic)
        return self._info("p", topic)

    def get_subscriptions_info_by_topic(self, topic):
        return self._info("s", topic)


def find(bits, names):
    return Found(bits, ("gid",), "python3", 1.0)


def reader(node):
    return GraphReader(node, "robot", find)


def test_nodes_endpoints_and_processes_without_the_observer():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    node.add("far", "s", "/t", 7, host="1234")
    graph = reader(node).update()
    assert [(n.name, n.host, n.pid) for n in graph.nodes] == [("/ns/far", "", 0), ("/ns/talker", "robot", 7)]
    assert [(e.node, e.role, e.name) for e in graph.endpoints] == [
        ("/ns/far", Role.SUBSCRIPTION, "/t"),
        ("/ns/talker", Role.PUBLISHER, "/t"),
    ]
    qos = graph.endpoints[1].qos
    assert (qos.reliability, qos.history, qos.deadline_s, qos.lease_s) == ("reliable", "", 0.0, 0.5)
    assert graph.endpoints[1].hash == ""
    assert [process.pid for process in graph.processes] == [7]


def test_endpoints_are_asked_for_where_something_changed_only():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    one = reader(node)
    one.update()
    node.asked.clear()
    one.update()
    assert node.asked == []
    node.add("talker", "p", "/u", 7)
    graph = one.update()
    assert node.asked == ["/u"]
    assert {end.name for end in graph.endpoints} == {"/t", "/u"}


def test_the_sweep_finds_what_no_list_of_a_node_shows():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    one = reader(node)
    one.update()
    node.add("talker", "p", "/t", 7)
    assert len(one.update().endpoints) == 1
    assert sum(one.sweep(1) for _ in range(4))
    assert len(one.update().endpoints) == 2


def test_all_topics_are_asked_anew_after_a_change_and_a_few_in_quiet_times():
    node = FakeNode()
    for number in range(100):
        node.add("talker", "p", f"/t{number}", 7)
    observation = Observation("robot", reader(node), NoCounters())

    def asked():
        node.asked.clear()
        observation.period(0.0, 1.0)
        return set(node.asked)

    for _ in range(2):
        observation.changed(0.0)
        in_turn = [asked() for _ in range(7)]
        assert {f"/t{number}" for number in range(100)} <= set.union(*in_turn)
        assert max(map(len, in_turn)) <= 20
        assert 0 < len(asked()) <= 5


def test_an_endpoint_whose_node_is_not_known_yet_is_asked_for_again():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    node.add("_NODE_NAME_UNKNOWN_", "s", "/t", 8)
    one = reader(node)
    assert len(one.update().endpoints) == 1
    assert one.unsettled
    node.ends.pop()
    node.add("listener", "s", "/t", 8)
    assert {end.node for end in one.update().endpoints} == {"/ns/talker", "/ns/listener"}
    assert not one.unsettled


def test_what_a_process_held_goes_with_it_and_comes_back_with_another():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    node.add("listener", "s", "/t", 8)
    one = reader(node)
    number = one.update().endpoints[1].gid
    assert one.node_of(number) == "/ns/talker"
    assert not one.ended(4711)
    assert one.ended(7)
    graph = one.update()  # the middleware still lists it
    assert [n.name for n in graph.nodes] == ["/ns/listener"]
    assert [process.pid for process in graph.processes] == [8]
    node.add("talker", "p", "/t", 9)  # started again before the middleware noticed
    assert {n.name: n.pid for n in one.update().nodes} == {"/ns/listener": 8, "/ns/talker": 9}
    del node.ends[1]
    assert {n.name: n.pid for n in one.update().nodes} == {"/ns/listener": 8, "/ns/talker": 9}


def test_the_services_of_an_action_are_one_endpoint_and_its_topics_stay():
    node = FakeNode()
    for service in ("send_goal", "cancel_goal", "get_result"):
        node.add("arm", "service", f"/move/_action/{service}", 7, "a/action/Move_SendGoal")
        node.add("hand", "client", f"/move/_action/{service}", 7, "a/action/Move_SendGoal")
    node.add("arm", "service", "/reset", 7, "a/srv/Reset")
    node.add("odd", "client", "/move/_action/get_result", 7, "a/action/Move_GetResult")
    node.add("arm", "p", "/move/_action/feedback", 7, "a/action/Move_FeedbackMessage")
    ends = {(end.node, end.role, end.name, end.type) for end in reader(node).update().endpoints}
    assert ends == {
        ("/ns/arm", Role.ACTION_SERVER, "/move", "a/action/Move"),
        ("/ns/hand", Role.ACTION_CLIENT, "/move", "a/action/Move"),
        ("/ns/arm", Role.SERVICE_SERVER, "/reset", "a/srv/Reset"),
        ("/ns/odd", Role.SERVICE_CLIENT, "/move/_action/get_result", "a/action/Move_GetResult"),
        ("/ns/arm", Role.PUBLISHER, "/move/_action/feedback", "a/action/Move_FeedbackMessage"),
    }


def test_a_node_that_leaves_while_it_is_asked_breaks_nothing():
    node = FakeNode()
    node.add("leaving", "p", "/t", 7)
    assert [n.name for n in reader(node).update().nodes] == ["/ns/leaving"]


class NoCounters:
    def read(self, now):
        return []

    def failures(self):
        return []

    def called(self):
        return []


def test_frames_tell_changes_once_and_a_misfit_again_when_it_is_back():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    node.add("listener", "s", "/t", 8, "a/msg/Other")
    observation = Observation("robot", reader(node), NoCounters())
    first = observation.changed(1.0)
    assert (first.sender, first.events, len(first.failures)) == ("robot/ros2", [], 1)
    assert observation.changed(2.0) is None
    listener = node.ends.pop()
    gone = observation.changed(3.0)
    assert [(e.change, e.entity) for e in gone.events] == [(Change.VANISHED, "node:/ns/listener")]
    node.ends.append(listener)
    assert len(observation.changed(4.0).failures) == 1
    assert observation.ended(4711, 5.0) is None
    assert [e.entity for e in observation.ended(7, 6.0).events] == ["node:/ns/talker"]
    # What it had sent is counted after it is gone, under its name.
    assert observation._name_of(gid(7, 1).hex()) == "/ns/talker"
    frame, stale = observation.period(7.0, 1.0)
    assert (frame.tallies, frame.graph, stale) == ([], None, False)


class Counted:
    def __init__(self, *counted):
        self.counted = counted

    def read(self, now):
        return [CountedSlot(7, "", tally, "") for tally in self.counted]

    def failures(self):
        return []

    def called(self):
        return []


def test_traffic_of_an_observer_is_not_told():
    node = FakeNode()
    node.add("talker", "p", "/diagnostics", 7)
    node.add("listener", "s", "/diagnostics", 8)
    node.ends.append(("_roslens_9", "/", "p", "/diagnostics", "a/msg/B", gid(9, 3)))

    class ReportedTopics:
        def read(self, now):
            tally = Tally("/diagnostics", "", "/ns/listener", 0.0, 1.0, count=5)
            return [CountedSlot(8, gid(pid, number).hex(), tally, "") for pid, number in ((9, 3), (7, 1))]

        def failures(self):
            return []

        def called(self):
            return []

    observation = Observation("robot", reader(node), ReportedTopics())
    observation.changed(1.0)
    frame, _ = observation.period(2.0, 1.0)
    assert [tally.publisher for tally in frame.tallies] == ["/ns/talker"]


def test_what_nodes_of_the_same_name_count_in_another_domain_is_not_told():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    node.add("listener", "s", "/t", 8)

    class ReportedTopics:
        def read(self, now):
            sent = Tally("/t", "/ns/talker", "", 0.0, 1.0, count=5)
            taken = Tally("/t", "", "/ns/listener", 0.0, 1.0, count=5)
            return [
                *(CountedSlot(pid, "", sent, "") for pid in (7, 1007)),
                *(CountedSlot(pid, gid(pid - 1, 1).hex(), taken, "") for pid in (8, 1008)),
            ]

        def failures(self):
            return []

        def called(self):
            return []

    observation = Observation("robot", reader(node), ReportedTopics())
    observation.changed(1.0)
    frame, _ = observation.period(2.0, 1.0)
    assert [(tally.publisher, tally.subscriber, tally.count) for tally in frame.tallies] == [
        ("/ns/talker", "", 5),
        ("/ns/talker", "/ns/listener", 5),
    ]


def test_silence_is_told_of_what_is_there_only():
    node = FakeNode()
    node.add("talker", "p", "/t", 7)
    counters = Counted(
        Tally("/t", "/ns/talker", "", 0.0, 1.0),
        Tally("/old", "/ns/talker", "", 0.0, 1.0),
        Tally("/last", "/ns/talker", "", 0.0, 1.0, count=1),
    )
    observation = Observation("robot", reader(node), counters)
    observation.changed(1.0)
    frame, _ = observation.period(2.0, 1.0)
    assert [tally.topic for tally in frame.tallies] == ["/last", "/t"]


def test_what_is_called_in_another_domain_is_not_told():
    node = FakeNode()
    node.add("server", "p", "/rosout", 7)

    class Services(NoCounters):
        def __init__(self):
            self.now = 0.0

        def read(self, now):
            self.now = now
            return []

        def called(self):
            def asked(service, pid, count):
                return Called(pid, slots.ASKED, Tally(service, "/ns/server", "", 0.0, 1.0, count, last=self.now))

            return [asked("/add", 7, 2), asked("/add", 1007, 40), asked("/elsewhere", 1007, 1)]

    observation = Observation("robot", reader(node), Services())
    observation.changed(1.0)
    reported = [observation.period(2.0 + second, 1.0)[0].samples for second in range(4)]
    assert [(str(one.entity), one.values) for one in reported[-1]] == [("service:/add", {"calls": 2.0})]
