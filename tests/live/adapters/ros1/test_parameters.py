from concurrent.futures import Future

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.parameters import MOST, MOST_UPDATES, RENEW_S, Parameters, grouped, put
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble
from roslens.model.graph import Change, Event


class Server:
    def __init__(self):
        self.tree, self.calls, self.wrong = {"rate": 10, "robot": {"base": {"gains": {"p": 0.5}}}}, [], False

    def _answer(self, call):
        self.calls.append(call)
        if self.wrong:
            raise CallError(Trouble.SILENT, "no answer")
        return self.tree

    def subscribe_parameters(self, api):
        return self._answer(f"subscribe {api}")

    def unsubscribe_parameters(self, api):
        self._answer(f"unsubscribe {api}")

    def parameters(self):
        return self._answer("get")


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def at_once(call):
    future = Future()
    try:
        future.set_result(call())
    except CallError as error:
        future.set_exception(error)
    return future


@pytest.fixture
def server():
    return Server()


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def parameters(server, clock):
    return Parameters(server, "http://me:1/", clock, at_once)


def test_all_is_read_once_and_no_event(parameters, server):
    assert parameters.step(1.0) == ([], [])
    assert parameters.step(2.0) == ([], [])
    assert server.calls == ["subscribe http://me:1/"]
    assert parameters.by_node([]) == {"": {"/rate": "10", "/robot/base/gains/p": "0.5"}}


def test_names_in_the_namespace_of_a_node_are_its_own(parameters):
    parameters.step(1.0)
    assert parameters.by_node(["/robot", "/robot/base", "/rate"]) == {
        "": {"/rate": "10"},
        "/robot/base": {"gains/p": "0.5"},
    }


def test_what_the_master_tells_is_an_event(parameters, server):
    parameters.step(1.0)
    parameters.note("/rate/", 20)
    parameters.note("/robot/base/gains/", {})
    parameters.note("/robot/arm/password/", "hunter2")
    assert parameters.step(2.0)[0] == [
        Event(2.0, Change.CHANGED, "parameter:/rate", "10 is now 20"),
        Event(2.0, Change.APPEARED, "parameter:/robot/arm/password", "is ***"),
        Event(2.0, Change.VANISHED, "parameter:/robot/base/gains/p", "was 0.5"),
    ]
    assert server.calls == ["subscribe http://me:1/"]


def test_what_was_not_told_is_found_later(parameters, server, clock):
    parameters.step(1.0)
    server.tree = {"rate": 30}
    clock.now = RENEW_S - 1
    assert parameters.step(2.0) == ([], [])
    clock.now = RENEW_S
    events, _ = parameters.step(3.0)
    assert [event.entity for event in events] == ["parameter:/rate", "parameter:/robot/base/gains/p"]
    assert server.calls == ["subscribe http://me:1/", "get"]


def test_a_launch_file_that_is_loaded_makes_all_be_read_anew(parameters, server):
    parameters.step(1.0)
    server.tree = {f"p{number}": number for number in range(MOST_UPDATES + 1)}
    for name, value in server.tree.items():
        parameters.note(f"/{name}/", value)
    parameters.step(2.0)
    assert server.calls[1:] == ["get"]
    assert len(parameters.by_node([])[""]) == MOST_UPDATES + 1


def test_a_new_master_is_asked_to_tell_again(parameters, server):
    parameters.step(1.0)
    server.tree = {}
    events, _ = parameters.step(2.0, restarted=True)
    assert [event.change for event in events] == [Change.VANISHED] * 2
    assert server.calls == ["subscribe http://me:1/"] * 2
    parameters.leave(pytest.fail)
    assert server.calls[-1] == "unsubscribe http://me:1/"


def test_a_server_that_does_not_answer_is_told_and_asked_again(parameters, server, clock):
    server.wrong = True
    _, (failure,) = parameters.step(1.0)
    assert "no answer" in failure.what
    assert parameters.step(2.0) == ([], [])
    server.wrong, clock.now = False, RENEW_S
    assert parameters.step(3.0) == ([], [])
    assert parameters.by_node([])[""]["/rate"] == "10"


def test_a_way_back_that_is_closed_leaves_reading(server, clock):
    Parameters(server, "", clock, at_once).step(1.0)
    assert server.calls == ["get"]


def test_endless_parameters_are_bounded_and_that_is_said(parameters, server):
    server.tree = {f"p{number}": number for number in range(MOST + 9)}
    _, (failure,) = parameters.step(1.0)
    assert "more than 20,000" in failure.what
    assert len(parameters.by_node([])[""]) == MOST


def test_below_a_secret_nothing_is_shown():
    values = {}
    put(values, "/", {"token": {"left": "abc", "right": [1]}, "key\n": 1, "ok": {"list": [{"password": "abc"}]}})
    assert values == {"/token/left": "***", "/token/right": "***", "/ok/list": "[{password: ***}]"}


NAMES = st.text("abc", min_size=1, max_size=2)
TREES = st.recursive(st.integers(), lambda inner: st.dictionaries(NAMES, inner, max_size=3), max_leaves=8)


@given(st.dictionaries(NAMES, TREES), st.lists(NAMES, min_size=1, max_size=3), TREES)
def test_an_update_is_as_if_all_were_read_anew(tree, path, value):
    values = {}
    put(values, "/", tree)
    put(values, "/".join(["", *path, ""]), value)
    *outer, last = path
    place = tree
    for part in outer:
        if not isinstance(place.get(part), dict):
            place[part] = {}
        place = place[part]
    place[last] = value
    anew = {}
    put(anew, "/", tree)
    assert values == anew


@given(st.dictionaries(st.lists(NAMES, min_size=1).map(lambda parts: "/" + "/".join(parts)), NAMES))
def test_grouping_loses_nothing(values):
    nodes = frozenset(list(values)[::2])
    back = {
        f"{node}/{name}" if node else name: value
        for node, own in grouped(values, nodes).items()
        for name, value in own.items()
    }
    assert back == values


def test_a_slow_server_is_not_waited_for(server, clock):
    asked = []
    parameters = Parameters(server, "", clock, lambda call: asked.append(Future()) or asked[-1])
    assert parameters.step(1.0) == ([], [])
    parameters.note("/rate/", 20)
    parameters.step(2.0)
    asked[0].set_result({"rate": 10, "other": 1})
    parameters.note("/rate/", 30)
    parameters.step(3.0)
    assert parameters.by_node([]) == {"": {"/rate": "30", "/other": "1"}}
    assert len(asked) == 1
