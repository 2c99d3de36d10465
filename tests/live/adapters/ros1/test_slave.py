import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.slave import Counter, Link, Slave, read_links, read_stats
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble

pytestmark = pytest.mark.timed

ROSPY = [
    1, "", [
        [["/rosout", 0, [[3, 1258, 0, True]]], ["/chat", 11340, [[1, 12034, 378, True], [2, 11794, 370, True]]]],
        [["/in", [[4, 2561, 62, -1, True]]]],
        [],
    ],
]  # fmt: skip
ROSCPP = [
    [["/rosout", [[0, 131, 131, 1, 0]]], ["/chat2", [[2, 10680, 10680, 356, 0]]]],
    [["/chat", [[1, 9646, 371, 5, 0]]]],
]
INFO = [
    [1, "/listener", "o", "TCPROS", "/chat", True, "TCPROS connection on port 42209 to [127.0.0.1:60998 on socket 8]"],
    [4, "http://127.0.0.1:38181/", "i", "TCPROS", "/in", True, "TCPROS connection on port 32772 to [127.0.0.1:1 on 1]"],
]
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=30,
)


def test_the_form_of_rospy():
    stats = read_stats(ROSPY, "n")
    assert not stats.wraps
    assert not stats.oddities
    assert stats.counters == (
        Counter("1", "/chat", True, 378, 12034),
        Counter("2", "/chat", True, 370, 11794),
        Counter("3", "/rosout", True, 0, 1258),
        Counter("4", "/in", False, 62, 2561),
    )


def test_the_form_of_roscpp_has_no_code_and_counts_drops():
    stats = read_stats(ROSCPP, "n")
    assert stats.wraps
    assert stats.counters == (
        Counter("0", "/rosout", True, 1, 131),
        Counter("1", "/chat", False, 371, 9646, 0, 5),
        Counter("2", "/chat2", True, 356, 10680),
    )
    assert read_stats([*ROSCPP, []], "n").counters == stats.counters


def test_a_row_that_counts_no_messages_is_named():
    stats = read_stats([1, "", [[], [["/in", [[4, 2561, -1, True]]]], []]], "n")
    assert stats.counters == ()
    assert "counters [4, 2561, -1, True]" in stats.oddities[0].what


@pytest.mark.parametrize("answer", [None, [], [1, "", 3], [1, "", [[]]], "x", [0, "no", []]])
def test_no_statistics(answer):
    with pytest.raises(CallError):
        read_stats(answer, "n")


def test_connections():
    links, oddities = read_links([*INFO, [1, 2], "x"], "n")
    assert links == (Link("1", "/chat", True, "/listener"), Link("4", "/in", False, "http://127.0.0.1:38181/"))
    assert len(oddities) == 2


@given(ANYTHING)
def test_no_value_makes_reading_fall_over(value):
    read_links(value, "n")
    for answer in (
        value,
        [1, "", value],
        [value, value],
        [1, "", [value, value]],
        [[["/t", [value]]], [["/t", [value]]]],
    ):
        try:
            stats = read_stats(answer, "n")
        except CallError:
            continue
        assert all(isinstance(c.count, int) and isinstance(c.bytes, int) for c in stats.counters)


@pytest.fixture
def node(serve):
    return serve({"getPid": [1, "", 4711], "getBusInfo": [1, "", INFO], "getBusStats": ROSPY})


def test_a_node_is_asked(node):
    node.answers["requestTopic"] = lambda caller, topic, protocols: [1, "", ["TCPROS", "robot", 4567]]
    slave = Slave(node.uri, "/me", Resolver())
    assert slave.pid() == 4711
    assert len(slave.links()[0]) == 2
    assert len(slave.stats().counters) == 4
    assert slave.request("/chat") == ("robot", 4567)
    assert node.calls[-1] == ("requestTopic", ("/me", "/chat", [["TCPROS"]]))
    slave.close()


@pytest.mark.parametrize("place", [[], ["TCPROS"], ["TCPROS", "h", "1"], ["TCPROS", "h", 0], ["TCPROS", "h", 70000], 0])
def test_a_place_that_is_none(node, place):
    node.answers["requestTopic"] = [1, "", place]
    slave = Slave(node.uri, "/me", Resolver())
    with pytest.raises(CallError) as caught:
        slave.request("/chat")
    slave.close()
    assert caught.value.trouble is Trouble.GARBLED


@pytest.mark.parametrize("pid", ["12", -4, 0, True, None, [1]])
def test_a_process_that_is_none(node, pid):
    node.answers["getPid"] = [1, "", pid]
    slave = Slave(node.uri, "/me", Resolver())
    with pytest.raises(CallError):
        slave.pid()
    slave.close()
