import os
import queue
import threading

import pytest

from roslens.live.act.order_line import serve
from roslens.live.act.orders import Orders
from roslens.live.act.ros import ActionError
from roslens.model.acting.order import VERSION, Order, OrderReader, Reply, Verb, encode_order

WAIT_S = 20.0
STOP = {"topic": "/stop", "type": "std_msgs/Bool", "fields": {"data": True}}


class ScriptedRos:
    """A ROS system that keeps what it is asked for, and answers what a test says."""

    def __init__(self, generation=2, answers=None, subscribers=1):
        self.generation = generation
        self.answers = answers or {}
        self.subscribers = subscribers
        self.did = []
        self.came = threading.Condition()

    def _did(self, *what):
        with self.came:
            self.did.append(what)
            self.came.notify_all()

    def advertise(self, topic, type_, fields, *, latched):
        self._did("advertise", topic, type_, latched)

    def publish(self, topic, type_, fields, *, latched):
        self._did("publish", topic, fields)
        return self.subscribers

    def meet(self, service, type_, fields):
        self._did("meet", service, type_, fields)

    def call(self, service, type_, fields, timeout_s):
        self._did("call", service, fields)
        if service not in self.answers:
            raise ActionError(f"no server offers {service}")
        return self.answers[service]

    def set_parameter(self, node, name, value, timeout_s):
        self._did("set", node, name, value)

    def log(self, level, text):
        self._did("log", level, text)

    def ready_to_log(self):
        self._did("ready to log")

    def record(self, patterns, before_s, path, after_s):
        self._did("record", patterns, before_s, path, after_s)
        return "recorded"


class Acting:
    def __init__(self, **how):
        self.ros = ScriptedRos(**how)
        self.replies = queue.SimpleQueue()
        self.orders = Orders(self.ros, self.replies.put)

    def order(self, kind, target="", verb=Verb.DO, id_="r/1.0", **arguments):
        self.orders.take(Order(VERSION, id_, verb, kind, target, arguments))
        return self.replies.get(timeout=WAIT_S)


@pytest.fixture
def act():
    made = []

    def make(**how):
        made.append(Acting(**how))
        return made[-1]

    yield make
    for one in made:
        one.orders.close()


def test_publishing_to_nobody_is_a_failure_unless_it_is_kept(act):
    acting = act(subscribers=0)
    assert not acting.order("publish", **STOP).done
    assert act().order("publish", **STOP).text.endswith("to 1 subscriber")
    assert acting.order("publish", **STOP, how="latched").text.endswith("to 0 subscribers")
    assert acting.order("publish", **STOP, how="repeated").done
    acting.orders.take(Order(VERSION, "", Verb.STOP))


def test_what_repeats_ends_when_it_is_cleared_and_when_all_is_stopped(act):
    acting = act()
    for verb, id_ in ((Verb.CLEAR, "r/1.0"), (Verb.STOP, "")):
        before = len(acting.ros.did)
        assert acting.order("publish", **STOP, how="repeated", rate=100).done
        with acting.ros.came:
            assert acting.ros.came.wait_for(lambda before=before: len(acting.ros.did) > before + 3, WAIT_S)
        acting.orders.take(Order(VERSION, id_, verb))
        assert not acting.orders._repeated
    assert "100 Hz" in acting.order("publish", **STOP, how="repeated", rate=1000, verb=Verb.PREPARE).text


def test_a_call_whose_answer_says_so_failed(act):
    reported = {"service": "/enable", "type": "std_srvs/SetBool"}
    assert act(answers={"/enable": {"success": True, "message": "yes"}}).order("call", **reported).done
    found = act(answers={"/enable": {"success": False, "message": "hot"}}).order("call", **reported)
    assert (found.done, "message: hot" in found.text) == (False, True)
    assert act(answers={"/enable": {}}).order("call", **reported).text == "/enable answered without fields"
    assert "no server offers" in act().order("call", **reported).text


def test_notices_go_where_they_are_asked_for(act):
    acting = act()
    assert acting.order("notify", text="hot", to=["rosout"]).done
    assert acting.ros.did == [("log", "warning", "hot")]
    acting = act()
    assert acting.order("notify", text="hot", level="error").done
    ((_, topic, fields),) = [one for one in acting.ros.did if one[0] == "publish"]
    assert (topic, fields["status"][0]["level"], fields["status"][0]["name"]) == (
        "/diagnostics",
        2,
        "roslens reaction: r",
    )


def test_what_was_said_is_kept_from_the_beginning_and_written_when_it_is_asked_for(act):
    acting = act()
    reported = {"topics": ["/scan", "/tf*"], "before": 5.0, "after": 0.0}
    assert acting.order("record", verb=Verb.PREPARE, **reported).done
    assert acting.order("record", **reported, path="/x/r.mcap").text == "recorded"
    assert acting.ros.did == [
        ("record", ("/scan", "/tf*"), 5.0, "", 0.0),
        ("record", ("/scan", "/tf*"), 5.0, "/x/r.mcap", 0.0),
    ]
    assert "up to 120 s each" in acting.order("record", verb=Verb.PREPARE, **{**reported, "after": 1000.0}).text


@pytest.mark.parametrize("value", [{"a": 1}, [1, "a"], None])
def test_no_parameter_has_such_a_value(act, value):
    assert not act().order("set_parameter", "/n", Verb.PREPARE, name="a", value=value).done


def test_a_shutdown_is_asked_for_by_the_state_that_the_node_is_in(act):
    states = {"/n/get_state": {"current_state": {"label": "active"}}, "/n/change_state": {"success": True}}
    acting = act(answers=states)
    assert acting.order("lifecycle", "/n", transition="shutdown").done
    assert acting.ros.did[-1] == ("call", "/n/change_state", {"transition": {"id": 7}})
    states["/n/get_state"] = {"current_state": {"label": "finalized"}}
    assert "'finalized'" in act(answers=states).order("lifecycle", "/n", transition="shutdown").text
    states["/n/change_state"] = {"success": False}
    assert not act(answers=states).order("lifecycle", "/n", transition="activate").done


def test_components_are_unloaded_by_their_number_and_not_loaded_twice(act):
    held = {"full_node_names": ["/a", "/ns/b"], "unique_ids": [3, 5]}
    list_nodes, answers = "/box/_container/list_nodes", {"success": True}
    acting = act(answers={list_nodes: held, "/box/_container/unload_node": answers})
    assert acting.order("unload", "/ns/b", container="/box").done
    assert acting.ros.did[-1][2] == {"unique_id": 5}
    assert "box holds /a, /ns/b" in acting.order("unload", "/c", container="/box").text
    reported = {"container": "/box", "package": "demo", "plugin": "demo::B", "namespace": "/ns"}
    acting = act(answers={list_nodes: held, "/box/_container/load_node": {**answers, "full_node_name": "/ns/c"}})
    assert "already" in acting.order("load", **reported, name="b").text
    found = acting.order("load", **reported, name="c", parameters={"rate": [1, 2.5]})
    assert found.text == "loaded /ns/c into /box"
    (parameter,) = acting.ros.did[-1][2]["parameters"]
    assert parameter["value"] == {"type": 8, "double_array_value": [1.0, 2.5]}
    refused = {list_nodes: held, "/box/_container/load_node": {"success": False, "error_message": "no such class"}}
    assert "no such class" in act(answers=refused).order("load", **reported, name="d").text


def test_what_is_not_done_through_ros_and_not_in_this_generation_is_refused(act):
    assert "not an action that is carried out through ROS" in act().order("restart", "/n").text
    assert "not an action" in act().order("rm -rf", "/n").text
    assert "does not exist in ROS 1" in act(generation=1).order("lifecycle", "/n", transition="activate").text


def test_an_error_of_ros_is_the_reason_of_the_failure(act):
    acting = act()
    acting.ros.log = lambda *_: 1 / 0
    assert "ZeroDivisionError" in acting.order("notify", text="x", to=["rosout"]).text


def test_the_line_carries_orders_and_replies_and_ends_at_what_is_none():
    told_read, reported = os.pipe()
    replies, replies_write = os.pipe()
    ros = ScriptedRos()
    thread = threading.Thread(target=serve, args=(told_read, replies_write, lambda say: Orders(ros, say)))
    thread.start()
    os.write(reported, encode_order(Order(VERSION, "a", Verb.DO, "notify", "", {"text": "x", "to": ["rosout"]})))
    (reply,) = OrderReader(Reply).feed(os.read(replies, 65536))
    assert (reply.id, reply.done) == ("a", True)
    os.write(reported, b"\xff" * 100)
    thread.join(WAIT_S)
    assert not thread.is_alive()
    for one in (told_read, reported, replies, replies_write):
        os.close(one)
