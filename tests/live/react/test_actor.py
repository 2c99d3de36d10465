import msgspec
import pytest

from roslens.live.join.session import Step
from roslens.live.react.actor import ANSWER_WITHIN_S, Actor, CarriedOut
from roslens.live.react.gate import Gate, Limits
from roslens.model.acting.reaction import ActionCall, Checked, Decision, Mode, Result, Verification
from roslens.model.entity import EntityId, EntityKind

STOP = {"topic": "/stop", "type": "std_msgs/Bool", "how": "repeated"}


def decision(number=1, kind="restart", **arguments):
    target = EntityId(EntityKind.NODE, "/driver") if kind == "restart" else None
    return Decision(f"r/{number}.0", "r", "node:/driver", 0, ActionCall(kind, target, arguments), 100.0)


class Scene:
    """An actor whose reactor, hands, journal and asker are lists."""

    def __init__(self, mode=Mode.ACT, **limits):
        self.due, self.outcomes, self.checked, self.truth, self.unwell = [], [], [], {}, ""
        self.spared = {}
        self.begun, self.came, self.cleared, self.stopped = [], [], [], 0
        self.entries, self.questions, self.said, self.withdrawn = [], [], [], []
        self.hold, self.now = "", 1000.0
        self.full = False
        self.actor = Actor(
            self, Gate(Limits(mode, **limits)), self, self, self, held=lambda: self.hold, steady=lambda: self.now
        )

    # the reactor
    def look(self, step, now_s):
        found, self.due = self.due, []
        return found

    def reported(self, decision_id, outcome):
        self.outcomes.append((decision_id, outcome.result, outcome.text))

    def checks(self):
        found, self.checked = self.checked, []
        return found

    def holds(self, decision_id):
        return self.truth.get(decision_id, True)

    # the journal
    def add(self, what, time, **fields):
        if self.full:
            raise OSError("full")
        msgspec.json.encode(fields)
        self.entries.append((what, fields))

    # the hands
    def do(self, one):
        self.begun.append((one.id, [what for what, _ in self.entries].count("announced")))

    def poll(self):
        found, self.came = self.came, []
        return found

    def clear(self, decision_id):
        self.cleared.append(decision_id)

    def stop(self):
        self.stopped += 1

    # who is asked
    def ask(self, one, until_s):
        self.questions.append(one.id)

    def answers(self):
        found, self.said = self.said, []
        return found

    def withdraw(self, decision_id):
        self.withdrawn.append(decision_id)

    def step(self, *due, seconds=0.1):
        self.due += due
        self.now += seconds
        self.actor.take(Step(self.now))

    def whats(self):
        return [what for what, _ in self.entries]


def test_what_is_done_is_announced_before_and_told_after():
    scene = Scene()
    scene.step(decision())
    assert scene.begun == [("r/1.0", 1)]
    assert scene.whats() == ["decided", "gate", "announced"]
    scene.came = [CarriedOut("r/1.0", True, "started", 0.5)]
    scene.checked = [Checked("r/1.0", Verification.GONE, 0.0)]
    scene.step()
    assert scene.outcomes == [("r/1.0", Result.DONE, "started")]
    assert scene.whats()[3:] == ["outcome", "verified"]


def test_without_a_journal_nothing_is_done():
    scene = Scene()
    scene.full = True
    with pytest.raises(OSError, match="full"):
        scene.step(decision())
    assert not scene.begun


@pytest.mark.parametrize(
    ("came", "result"),
    [
        (CarriedOut("r/1.0", False, "no"), Result.FAILED),
        (CarriedOut("r/1.0", False, "no", refused=True), Result.REFUSED),
    ],
)
def test_what_failed_and_what_was_refused_are_told_apart(came, result):
    scene = Scene()
    scene.step(decision())
    scene.came = [came, CarriedOut("other/1.0", True, "not ours")]
    scene.step()
    assert scene.outcomes == [("r/1.0", result, "no")]


def test_a_dry_run_does_nothing_and_counts_all_the_same():
    scene = Scene(Mode.DRY_RUN)
    scene.step(decision())
    scene.step(decision(2))
    assert not scene.begun
    assert [result for _, result, _ in scene.outcomes] == [Result.DRY_RUN]
    assert scene.entries[-1][1]["gate"] == "wait", "as it would have had to"


def test_what_has_to_wait_is_done_later_if_it_is_still_to_be_done():
    scene = Scene(cool_down_s=10.0)
    scene.step(decision())
    scene.step(decision(2), decision(3))
    scene.step(seconds=5.0)
    assert [one for one, _ in scene.begun] == ["r/1.0"]
    scene.truth["r/3.0"] = False
    scene.step(seconds=6.0)
    assert [one for one, _ in scene.begun] == ["r/1.0", "r/2.0"]
    assert scene.outcomes == [("r/3.0", Result.REFUSED, "its condition no longer holds")]
    gates = [(fields["decision"], fields["gate"]) for what, fields in scene.entries if what == "gate"]
    assert gates == [("r/1.0", "allow"), ("r/2.0", "wait"), ("r/3.0", "wait"), ("r/2.0", "allow")]


def test_nothing_waits_for_ever_nor_through_a_hold():
    scene = Scene(at_most=0)
    scene.step(decision())
    scene.step(seconds=400.0)
    assert "300 s" in scene.outcomes[-1][2]
    scene.step(decision(2))
    scene.hold = "ann"
    scene.step()
    assert scene.outcomes[-1][:2] == ("r/2.0", Result.HELD)


def test_who_is_asked_decides():
    scene = Scene(Mode.ASK, cool_down_s=0.0)
    scene.step(decision(), decision(2))
    assert scene.questions == ["r/1.0", "r/2.0"]
    assert [result for _, result, _ in scene.outcomes] == [Result.ASKED, Result.ASKED]
    scene.said = [("r/1.0", True, "ann"), ("r/2.0", False, "ann"), ("r/1.0", True, "ann")]
    scene.step()
    assert scene.begun == [("r/1.0", 1)]
    assert scene.outcomes[-1] == ("r/2.0", Result.REFUSED, "ann refused")


def test_an_answer_that_comes_when_the_cause_is_gone_or_all_is_held_does_nothing():
    scene = Scene(Mode.ASK)
    scene.step(decision())
    scene.truth["r/1.0"] = None
    scene.said = [("r/1.0", True, "ann")]
    scene.step()
    assert scene.outcomes[-1][1] is Result.REFUSED
    scene.step(decision(2))
    scene.hold = "bob"
    scene.said = [("r/2.0", True, "ann")]
    scene.step()
    assert scene.outcomes[-1][1] is Result.HELD
    assert not scene.begun


def test_a_question_is_withdrawn_when_nobody_answers_or_its_cause_is_gone():
    scene = Scene(Mode.ASK, cool_down_s=0.0)
    scene.step(decision(), decision(2))
    scene.truth["r/1.0"] = False
    scene.step()
    assert scene.withdrawn == ["r/1.0"]
    scene.step(seconds=ANSWER_WITHIN_S + 1)
    assert scene.withdrawn == ["r/1.0", "r/2.0"]
    assert "no answer within" in scene.outcomes[-1][2]


def test_what_repeats_ends_when_its_cause_is_gone():
    scene = Scene()
    scene.step(decision(1, "publish", **STOP))
    scene.truth["r/1.0"] = None
    scene.step()
    assert not scene.cleared, "unknown is not gone"
    scene.truth["r/1.0"] = False
    scene.step()
    scene.step()
    assert scene.cleared == ["r/1.0"]


def test_a_hold_stops_what_is_under_way_and_a_release_frees_what_was_given_up():
    scene = Scene(cool_down_s=0.0, most_restarts=1)
    scene.step(decision())
    scene.step(decision(2))
    assert scene.outcomes[-1][1] is Result.GAVE_UP
    scene.hold = "by ann: the gripper"
    scene.step(decision(3))
    assert scene.stopped == 1
    assert scene.outcomes[-1][1] is Result.HELD
    scene.hold = ""
    scene.step(decision(4))
    assert scene.begun[-1][0] == "r/4.0"
    reported = [(what, fields["text"]) for what, fields in scene.entries if what in ("held", "released")]
    assert reported[0] == ("held", "by ann: the gripper")
    assert reported[-1] == ("released", "restarted again from now on: node:/driver")


def test_that_the_monitor_is_unwell_is_told_once():
    scene = Scene()
    for unwell in ("", "late", "late", "", ""):
        scene.unwell = unwell
        scene.step()
    assert scene.whats() == ["unwell", "well"]


def test_what_nobody_tells_of_has_failed():
    scene = Scene()
    scene.step(decision())
    scene.step(seconds=1000.0)
    assert "no result was reported" in scene.outcomes[-1][2]
