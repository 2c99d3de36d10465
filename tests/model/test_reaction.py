"""Reactions and decisions go into journals and over lines: nothing of them is lost on the way."""

import msgspec
import pytest

from roslens.model.acting.condition import About, AllOf, AnyOf, AtLeast, Not, OverTime, Stated
from roslens.model.acting.reaction import ActionCall, Because, Decision, EscalationStep, Mode, Reaction
from roslens.model.entity import EntityId, EntityKind
from roslens.model.selector import Selector

SILENT = Stated(Selector(EntityKind.TOPIC, "/scan"), states=("absent",), time=OverTime(for_s=2.0))
GONE = Stated(Selector(EntityKind.NODE, "/lidar"), About.BEING, ("gone",))
TREE = AllOf(
    (
        AnyOf((SILENT, Not(GONE, OverTime(within_s=5.0, of=SILENT)))),
        AtLeast(2, (SILENT, GONE, Not(SILENT))),
    ),
    OverTime(after_start_s=30.0),
)
RESTART = ActionCall("restart", EntityId(EntityKind.NODE, "{entity}"), {"grace_s": 5, "keep": [True, None]})
REACTION = Reaction("robot.lidar", TREE, (EscalationStep(RESTART, 10.0),), unless=GONE, mode=Mode.ASK)
DECISION = Decision("robot.lidar/1.0", "robot.lidar", "node:/lidar", 0, RESTART, 5.0, (Because("a", "b", "c", 1.0),))


@pytest.mark.parametrize(("value", "kind"), [(REACTION, Reaction), (DECISION, Decision)])
def test_a_reaction_is_the_same_after_it_was_written_and_read(value, kind):
    assert msgspec.json.decode(msgspec.json.encode(value), type=kind) == value
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(value), type=kind) == value
