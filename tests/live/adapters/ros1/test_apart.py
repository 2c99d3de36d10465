"""Publishers and subscriptions that are not connected though both run, as the lists of publishers show it."""

from roslens.live.adapters.ros1.beyond_master.apart import MOST_PUBLISHERS, PATIENCE, Apart
from roslens.live.adapters.ros1.bus import Reading
from roslens.live.adapters.ros1.graph import build_graph
from roslens.live.adapters.ros1.master import SystemState
from roslens.live.adapters.ros1.slave import BusStats, Link
from roslens.live.system.misfit import misfits, misfits_by_topic
from roslens.model.graph import Node, Role

TYPES = {"/t": "a/B"}


def state(publishers=("/p",), subscribers=("/s",)):
    return SystemState(tuple(("/t", one) for one in publishers), tuple(("/t", one) for one in subscribers), ())


def reading(node, *subscribers):
    links = tuple(Link(str(number), "/t", True, one) for number, one in enumerate(subscribers))
    return Reading(node, f"http://{node}", 0.0, BusStats(), links)


def seen(apart, known, types=None):
    nodes = {name: Node(name) for _, name in (*known.publishers, *known.subscribers)}
    own = types or {}
    return apart.completed(build_graph(known, TYPES, nodes), lambda _, node: own.get(node, ""))


def after(rounds, known, *readings):
    apart = Apart()
    for _ in range(rounds):
        apart.take(known, readings)
    return apart


def subscription(graph):
    (found,) = (end for end in graph.endpoints if end.role is Role.SUBSCRIPTION)
    return found


def test_who_is_connected_is_not_apart():
    known = state()
    graph = seen(after(1, known, reading("/p", "/s"), reading("/s")), known)
    assert (subscription(graph).apart, subscription(graph).type) == ((), "a/B")
    assert misfits_by_topic(graph.endpoints, by_connection=True) == {"/t": 0}


def test_who_is_not_connected_for_long_is_apart_and_named():
    known = state()
    graph = seen(after(PATIENCE, known, reading("/p"), reading("/s")), known, {"/p": "a/C"})
    assert (subscription(graph).apart, subscription(graph).type) == (("/p",), "")
    (failure,) = misfits(graph.endpoints)
    assert failure.what == (
        "/s gets nothing of what /p publishes on /t: they are not connected, though both run; a/C is published"
    )
    assert misfits_by_topic(graph.endpoints, by_connection=True) == {"/t": 1}


def test_who_began_just_now_is_not_yet_judged():
    known = state()
    graph = seen(after(PATIENCE - 1, known, reading("/p"), reading("/s")), known)
    assert subscription(graph).apart is None
    assert misfits_by_topic(graph.endpoints, by_connection=True) == {}


def test_of_who_does_not_answer_nothing_new_is_known():
    known = state()
    apart = after(PATIENCE, known, reading("/p", "/s"), reading("/s"))
    for _ in range(PATIENCE):
        apart.take(known, [reading("/s")])
    assert subscription(seen(apart, known)).apart == ()
    assert subscription(seen(after(3 * PATIENCE, known, reading("/s")), known)).apart is None


def test_who_connects_late_is_apart_no_more():
    known = state()
    apart = after(PATIENCE, known, reading("/p"), reading("/s"))
    apart.take(known, [reading("/p", "/s"), reading("/s")])
    assert subscription(seen(apart, known)).apart == ()


def test_publishers_are_asked_for_their_types_where_there_are_several_or_one_is_apart():
    several = state(("/p", "/q"))
    assert Apart().wanted(several) == [("/t", "/p"), ("/t", "/q")]
    assert Apart().wanted(state()) == []
    assert after(PATIENCE, state(), reading("/p"), reading("/s")).wanted(state()) == [("/t", "/p")]
    assert Apart().wanted(state([f"/p{number}" for number in range(MOST_PUBLISHERS + 1)])) == []


def test_publishers_of_several_types_are_named_though_nobody_subscribes():
    known = state(("/p", "/q"), ())
    graph = seen(Apart(), known, {"/p": "a/B", "/q": "a/C"})
    assert [one.what for one in misfits(graph.endpoints)] == ["/p and /q publish different types on /t: a/B and a/C"]
