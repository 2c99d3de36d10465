"""What is remembered of what is gone stays small, however long a watch lasts."""

from roslens.judge.read_reference import GivenText, load_reference
from roslens.live.newest import MOST_GONE, keep_newest
from roslens.live.session import Session
from roslens.live.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.sample import Sample
from roslens.model.wire import VERSION, Frame

REFERENCE = "kind: reference\nname: r\nconstraints:\n  - {topic: /expected, rate: 5..8 Hz}\n"


def test_what_was_put_first_goes_first():
    kept = dict.fromkeys("abcd", 1)
    kept.pop("a")
    kept["a"] = 2
    keep_newest(kept, 2)
    assert kept == {"d": 1, "a": 2}
    keep_newest(kept, 5)
    assert kept == {"d": 1, "a": 2}


def test_a_watch_forgets_what_came_and_went_but_not_what_is_expected():
    session = Session(load_reference([GivenText("r.yaml", REFERENCE.encode())], BY_KEY), start=0.0)
    world = session.monitor.world
    many = MOST_GONE + 200
    for number in range(many):
        names = ["/stays", f"/tool_{number}"] + (["/expected"] if number == 0 else [])
        ends = [Endpoint(name, Role.PUBLISHER, name) for name in names]
        graph = Graph("ros2", tuple(Node(name, "base", 7) for name in names), tuple(ends), ("base",))
        samples = [Sample(EntityId(EntityKind.NODE, name), float(number), {"cpu": 1.0}) for name in names]
        session.take([Frame(VERSION, "base/ros2", number, float(number), [], samples, [], graph)])
        session.look(float(number))
    session.look(many + 1000.0)
    tools = [name for name in world.topics if name.startswith("/tool_")]
    # The newest is there still; it has not gone.
    assert len(tools) <= MOST_GONE + 1
    assert f"/tool_{many - 1}" in tools
    assert {"/stays", "/expected"} <= set(world.topics)
    assert len([one for one in world.sampled if one.name.startswith("/tool_")]) <= 301
