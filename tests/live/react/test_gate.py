import time

import msgspec
import pytest

from roslens.live.react.gate import Answer, Gate, Limits, recalled, target_of
from roslens.live.react.maintenance import parse_window
from roslens.live.react.node_places import Home
from roslens.model.acting.reaction import ActionCall, Decision, Mode
from roslens.model.entity import EntityId, EntityKind

NOON = time.mktime((2026, 3, 2, 12, 0, 0, 0, 0, -1))  # a Monday


def decision(kind="restart", node="/driver", mode=None, **arguments):
    target = EntityId(EntityKind.NODE, node) if node else None
    return Decision("r/1.0", "r", "topic:/scan", 0, ActionCall(kind, target, arguments), 0.0, mode=mode)


def judge(gate, one, now=100.0, wall=NOON, held=""):
    return gate.judge(one, now, wall_s=wall, held=held)


def test_it_is_off_unless_enabled():
    found = judge(Gate(Limits()), decision())
    assert (found.answer, "--mode" in found.text) == (Answer.REFUSE, True)


@pytest.mark.parametrize(
    ("of_all", "own", "expected"),
    [
        (Mode.ACT, None, Answer.ALLOW),
        (Mode.ASK, None, Answer.ASK),
        (Mode.DRY_RUN, None, Answer.DRY_RUN),
        (Mode.ACT, Mode.ASK, Answer.ASK),
        (Mode.DRY_RUN, Mode.ACT, Answer.DRY_RUN),
        (Mode.ASK, Mode.ACT, Answer.ASK),
    ],
)
def test_the_more_careful_mode_counts(of_all, own, expected):
    assert judge(Gate(Limits(of_all)), decision(mode=own)).answer is expected


def test_what_only_tells_is_not_asked_for():
    gate = Gate(Limits(Mode.ASK))
    assert judge(gate, decision("notify", "", text="x")).answer is Answer.ALLOW
    assert judge(gate, decision("publish", "", topic="/stop")).answer is Answer.ASK


def test_a_hold_is_before_everything():
    found = judge(Gate(Limits(Mode.ACT)), decision("notify", ""), held="ann, moving the arm by hand")
    assert found.answer is Answer.HELD
    assert "moving the arm" in found.text


def test_the_same_action_on_the_same_entity_cools_down():
    gate = Gate(Limits(Mode.ACT, cool_down_s=10.0))
    gate.done(decision(), 100.0)
    found = judge(gate, decision(), 104.0)
    assert (found.answer, "6.0 s are left" in found.text, found.again_s) == (Answer.WAIT, True, 6.0)
    assert judge(gate, decision(node="/other"), 104.0).answer is Answer.ALLOW
    assert judge(gate, decision("stop"), 104.0).answer is Answer.ALLOW
    assert judge(gate, decision(), 110.0).answer is Answer.ALLOW


def test_what_another_reaction_does_to_a_process_has_its_effect_first():
    gate = Gate(Limits(Mode.ACT, cool_down_s=10.0))
    gate.done(decision("restart"), 100.0)
    other = msgspec.structs.replace(decision("start"), reaction="gone")
    found = judge(gate, other, 130.0)
    assert (found.answer, "is under way for r" in found.text) == (Answer.WAIT, True), "however long it takes"
    gate.ended(msgspec.structs.replace(decision("restart"), id="another"), 130.0)
    assert judge(gate, other, 150.0).answer is Answer.WAIT
    gate.ended(decision("restart"), 130.0)
    found = judge(gate, other, 132.0)
    assert (found.answer, "was done for r 2.0 s ago" in found.text) == (Answer.WAIT, True)
    assert judge(gate, decision("kill"), 132.0).answer is Answer.ALLOW, "the chain that began it goes on"
    assert judge(gate, other, 140.0).answer is Answer.ALLOW
    elsewhere = msgspec.structs.replace(decision("start", "/other"), reaction="gone")
    assert judge(gate, elsewhere, 132.0).answer is Answer.ALLOW


def test_nodes_of_one_process_are_restarted_once_whoever_asks_for_it():
    homes = {"/left": Home("robot", 7, ("/right",)), "/right": Home("robot", 7, ("/left",)), "/arm": Home("robot", 8)}
    gate = Gate(Limits(Mode.ACT, cool_down_s=10.0, most_restarts=2), homes.get)
    left, right = decision(node="/left"), msgspec.structs.replace(decision(node="/right"), id="r/2.0")
    gate.done(left, 100.0)
    for other in (right, msgspec.structs.replace(right, reaction="r2")):
        found = judge(gate, other, 101.0)
        assert (found.answer, "whose process robot/7 holds node:/right too" in found.text) == (Answer.WAIT, True)
    gate.ended(left, 103.0)
    assert judge(gate, right, 104.0).answer is Answer.WAIT
    assert judge(gate, decision(node="/arm"), 104.0).answer is Answer.ALLOW
    homes["/left"] = homes["/right"] = Home("robot", 9)
    assert judge(gate, right, 114.0).answer is Answer.ALLOW
    gate.done(right, 114.0)
    assert judge(gate, right, 130.0).answer is Answer.GIVE_UP, "that of /left was one of its own, too"


def test_there_is_a_limit_for_all_and_notices_do_not_use_it_up():
    gate = Gate(Limits(Mode.ACT, at_most=2, per_s=60.0))
    for number in range(5):
        gate.done(decision("notify", f"/n{number}"), 100.0)
    assert judge(gate, decision("notify", "/other")).answer is Answer.WAIT
    stop = decision("publish", "", topic="/stop")
    assert judge(gate, stop).answer is Answer.ALLOW
    gate.done(decision(node="/a"), 100.0)
    gate.done(decision(node="/b"), 130.0)
    found = judge(gate, stop, 131.0)
    assert ("limit for all" in found.text, found.again_s) == (True, 29.0)
    assert judge(gate, stop, 160.0).answer is Answer.ALLOW


def test_after_the_most_restarts_it_gives_up_until_released():
    gate = Gate(Limits(Mode.ACT, cool_down_s=0.0, most_restarts=2, restarts_per_s=600.0))
    for at in (0.0, 100.0):
        assert judge(gate, decision(), at).answer is Answer.ALLOW
        gate.done(decision(), at)
    found = judge(gate, decision(), 200.0)
    assert (found.answer, "restarted 2 times in 600 s" in found.text) == (Answer.GIVE_UP, True)
    assert judge(gate, decision(), 10_000.0).answer is Answer.GIVE_UP, "time alone mends nothing"
    assert judge(gate, decision("stop"), 10_000.0).answer is Answer.ALLOW, "what a chain goes on with"
    assert judge(gate, decision(node="/other"), 10_000.0).answer is Answer.ALLOW
    assert gate.release() == ("node:/driver",)
    assert judge(gate, decision(), 10_001.0).answer is Answer.ALLOW


def test_slow_restarts_are_no_reason_to_give_up():
    gate = Gate(Limits(Mode.ACT, cool_down_s=0.0, most_restarts=2, restarts_per_s=600.0))
    for at in (0.0, 500.0, 1000.0, 1500.0):
        assert judge(gate, decision(), at).answer is Answer.ALLOW
        gate.done(decision(), at)


def test_what_was_done_before_a_restart_of_the_monitor_counts():
    gate = Gate(Limits(Mode.ACT, cool_down_s=10.0, most_restarts=2))
    recalled(gate, [(decision(), 5.0), (decision(), 300.0)], 1000.0)
    assert "cool-down" in judge(gate, decision(), 1000.0).text
    assert judge(gate, decision(), 1006.0).answer is Answer.GIVE_UP


def test_in_a_maintenance_window_only_what_tells_is_done():
    gate = Gate(Limits(Mode.ACT, windows=(parse_window("Mon 11:30-12:30"),)))
    found = judge(gate, decision())
    assert (found.answer, found.text) == (Answer.REFUSE, "maintenance: Mon 11:30-12:30")
    assert judge(gate, decision("notify", "")).answer is Answer.ALLOW
    assert judge(gate, decision(), wall=NOON + 1800).answer is Answer.ALLOW
    assert judge(gate, decision(), wall=NOON + 86_400).answer is Answer.ALLOW


def test_what_an_action_is_done_to_has_a_name():
    assert target_of(decision()) == "node:/driver"
    assert target_of(decision("publish", "", topic="/stop")) == "/stop"
    assert target_of(decision("snapshot", "")) == "topic:/scan"
