import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.master import Master, read_state, read_types
from roslens.live.adapters.ros1.names import LONGEST_NAME, Oddities, brief
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble

pytestmark = pytest.mark.timed

ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=20,
)


@pytest.fixture
def master(system):
    system.publishers = {"/chat": {"/b", "/a"}}
    system.subscribers = {"/chat": {"/c"}}
    system.services = {"/a/get_loggers": {"/a"}}
    system.types = {"/chat": "std_msgs/String", "/other": "*"}
    found = Master(system.master.uri, "/me", Resolver())
    yield found
    found.close()


def test_registrations_are_read_and_sorted(master):
    state, changed = master.state()
    assert changed
    assert state.publishers == (("/chat", "/a"), ("/chat", "/b"))
    assert state.subscribers == (("/chat", "/c"),)
    assert state.services == (("/a/get_loggers", "/a"),)
    assert state.nodes == ("/a", "/b", "/c")
    assert not state.oddities


def test_an_unchanged_answer_is_told_as_such(master, system):
    master.state()
    assert master.state()[1] is False
    system.publishers["/new"] = {"/a"}
    assert master.state()[1] is True


def test_an_unknown_type_is_empty(master):
    assert master.types() == ({"/chat": "std_msgs/String", "/other": ""}, ())


def test_homes_are_remembered_until_asked_afresh(master, system):
    system.node("/a")
    first = master.home("/a")
    system.node("/a")
    assert master.home("/a") == first
    assert master.home("/a", fresh=True) == system.nodes["/a"].uri != first
    with pytest.raises(CallError, match="unknown node") as caught:
        master.home("/nobody")
    assert caught.value.trouble is Trouble.DENIED


@pytest.mark.parametrize("uri", [7, [], "rosrpc://x:1", "http://x"])
def test_a_home_that_is_no_uri_is_garbled(master, system, uri):
    system.master.answers["lookupNode"] = [1, "", uri]
    with pytest.raises(CallError) as caught:
        master.home("/a")
    assert caught.value.trouble is Trouble.GARBLED


def test_hostile_names_are_left_out_and_named():
    long = "/" + "x" * 10_000
    state = read_state([[["/ok", ["/n", long, 7, "", "/a\nb"]], [long, ["/n"]], "x"], [], []], "http://m:1")
    assert state.publishers == (("/ok", "/n"),)
    said = [str(failure) for failure in state.oddities]
    assert any("10,001 long" in text for text in said)
    assert all(len(text) < 400 for text in said)
    assert all(failure.partial and failure.entity == "http://m:1" for failure in state.oddities)


def test_unicode_and_hyphens_are_names():
    state = read_state([[["/ルンバ-1", ["/ñandú"]]], [], []], "m")
    assert state.publishers == (("/ルンバ-1", "/ñandú"),)


def test_a_thousand_oddities_are_a_few_lines():
    oddities = Oddities("m")
    for number in range(1000):
        oddities.add("the name", number, "a text")
    said = oddities.failures()
    assert len(said) == 4
    assert said[-1].what == "997 more of: the name"


def test_too_many_registrations_are_cut_and_named():
    state = read_state([[["/t", [f"/n{number}" for number in range(100_050)]]], [], []], "m")
    assert len(state.publishers) == 100_000
    assert "after the first 100,000" in state.oddities[0].what


def test_longest_name():
    name = "/" + "x" * (LONGEST_NAME - 1)
    assert read_state([[[name, [name]]], [], []], "m").publishers == ((name, name),)


@given(ANYTHING)
def test_no_value_makes_reading_fall_over(value):
    try:
        state = read_state(value, "m")
    except CallError:
        pass
    else:
        assert all(isinstance(name, str) and isinstance(node, str) for name, node in state.publishers)
    types, _ = read_types(value, "m")
    assert all(isinstance(name, str) for name in types)
    assert len(brief(value)) <= 80


@given(st.lists(ANYTHING, min_size=3, max_size=3))
def test_three_lists_of_anything_are_read(value):
    read_state(value, "m")
