"""What holds of every reactor, whatever happens: unknown never acts, nothing twice, nothing out of order."""

from __future__ import annotations

import itertools
import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.join.session import Step
from roslens.live.react.reactor import Reactor
from roslens.live.react.wellness import BEGINNING_S
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.reaction import Checked, Decision, Outcome, Result, Verification
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State, Verdict

REACTIONS = load_reference(
    [
        GivenText(
            "r.yaml",
            b"""
kind: reference
name: r
reactions:
- id: chain
  when: {node: "/*", is: bad, match: each, for: 1 s}
  settled: 1 s
  cool_down: 4 s
  do: [{notify: "{entity}"}, {restart: "{entity}", verify: 2 s}, {kill: "{entity}", verify: 1 s}, {snapshot: {}}]
- {id: effects, settled: 0 s, cool_down: 3 s, when: {topic: "/*", is: bad, effects: true}, do: [{snapshot: {}}]}
- id: tree
  settled: 500 ms
  when: {all: [{topic: /t, is: [low, absent]}, {not: {node: /a, is: bad}}]}
  only_while: {node: /b, is: ok}
  unless: {topic: /u, is: bad}
  do: [{restart: /b, verify: 1 s}, {stop: /b}]
""",
        )
    ],
    BY_KEY,
).reactions
VERIFY_S = {("r.chain", 1): 2.0, ("r.chain", 2): 1.0, ("r.tree", 0): 1.0}
COOL_DOWN_S = {one.name: one.cool_down_s for one in REACTIONS}
ENTITIES = ("node:/a", "node:/b", "topic:/t", "topic:/u")
STEP_S = 0.25
UNKNOWN = (State.UNKNOWN, State.SUSPENDED)

happenings = st.lists(
    st.tuples(
        st.integers(0, 79),
        st.sampled_from(ENTITIES),
        st.sampled_from(list(State)),
        st.sampled_from(("", "", "node:/a", "host:h")),
    ),
    max_size=25,
)
results = st.lists(st.sampled_from(list(Result)), min_size=1, max_size=8)


def verdict(entity: str, state: State, cause: str, at: float) -> Verdict:
    known = EntityId.parse(entity)
    return Verdict(known, f"s.{known.name}", "presence", state, at, at, cause=cause if state.bad else "")


def steps_of(happened: Any, first: State = State.OK) -> list[Step]:
    """Return steps a quarter of a second apart; in the first seconds nothing happens."""
    begin = round(BEGINNING_S / STEP_S)
    found = [Step(STEP_S, tuple(verdict(entity, first, "", STEP_S) for entity in ENTITIES))]
    found += [Step(number * STEP_S) for number in range(2, begin)]
    for number in range(80):
        at = (begin + number) * STEP_S
        latest = {
            entity: verdict(entity, state, cause, at) for turn, entity, state, cause in happened if turn == number
        }
        found.append(Step(at, tuple(latest.values())))
    return found


class Ran:
    """What a reactor decided along steps, with what was the case at each."""

    def __init__(self, steps: list[Step], outcomes: list[Result], reactions: Any = REACTIONS) -> None:
        reactor = Reactor(reactions, start=0.0)
        self.decisions: list[Decision] = []
        self.checks: list[Checked] = []
        self.outcomes: dict[str, Result] = {}
        self.held: dict[float, dict[str, Verdict]] = {}
        now: dict[str, Verdict] = {}
        for step in steps:
            now.update({str(one.entity): one for one in step.changes})
            self.held[step.time] = dict(now)
            for decision in reactor.look(step, step.time):
                result = outcomes[len(self.decisions) % len(outcomes)]
                self.decisions.append(decision)
                self.outcomes[decision.id] = result
                reactor.reported(decision.id, Outcome(result))
            self.checks += reactor.checks()

    def reported(self) -> list[tuple[Any, ...]]:
        return [(one.at_s, one.reaction, one.entity, one.step, one.because) for one in self.decisions]


@given(happenings, results)
@settings(max_examples=60, deadline=None)
def test_what_is_decided_is_known_to_be_so(happened, outcomes):
    ran = Ran(steps_of(happened), outcomes)
    for one in ran.decisions:
        held = ran.held[one.at_s]
        assert one.because
        for because in one.because:
            found = held[because.entity]
            assert found.state.value == because.state
            assert found.state not in UNKNOWN
        if one.reaction == "r.chain":
            assert held[one.entity].state.bad
            assert held[one.entity].cause == ""
            assert one.first_cause == one.entity
        if one.reaction == "r.tree":
            assert held["node:/b"].state is State.OK
            assert held["node:/a"].state is State.OK
            assert held["topic:/u"].state is State.OK


@given(happenings, results)
@settings(max_examples=40, deadline=None)
def test_unknown_never_acts(happened, outcomes):
    blind = [(turn, entity, UNKNOWN[turn % 2], cause) for turn, entity, _, cause in happened]
    assert Ran(steps_of(blind, State.UNKNOWN), outcomes).decisions == []
    assert Ran(steps_of(blind), outcomes).decisions == []


@given(happenings, results)
@settings(max_examples=60, deadline=None)
def test_nothing_is_begun_again_while_it_cools_down(happened, outcomes):
    latest: dict[tuple[str, str], float] = {}
    for one in Ran(steps_of(happened), outcomes).decisions:
        # What is not bound to each is one chain, whatever it is about.
        key = (one.reaction, one.entity if one.reaction == "r.chain" else "")
        if one.step == 0 and key in latest:
            assert one.at_s - latest[key] >= COOL_DOWN_S[one.reaction] - 1e-6
        latest[key] = one.at_s


@given(happenings, results, st.randoms(use_true_random=False))
@settings(max_examples=40, deadline=None)
def test_no_order_matters(happened, outcomes, chance: random.Random):
    reactions = list(REACTIONS)
    chance.shuffle(reactions)
    steps = [Step(one.time, tuple(chance.sample(one.changes, len(one.changes)))) for one in steps_of(happened)]
    assert Ran(steps, outcomes, reactions).reported() == Ran(steps_of(happened), outcomes).reported()


@given(happenings, results)
@settings(max_examples=60, deadline=None)
def test_escalation_goes_step_by_step_and_waits_for_verification(happened, outcomes):
    ran = Ran(steps_of(happened), outcomes)
    chains: dict[str, list[Decision]] = {}
    for one in ran.decisions:
        chains.setdefault(one.id.rpartition(".")[0], []).append(one)
    for chain in chains.values():
        assert [one.step for one in chain] == list(range(len(chain)))
        for before, after in itertools.pairwise(chain):
            result = ran.outcomes[before.id]
            assert result in (Result.DONE, Result.DRY_RUN, Result.FAILED, Result.GAVE_UP)
            if result in (Result.DONE, Result.DRY_RUN):
                assert after.at_s - before.at_s >= VERIFY_S.get((before.reaction, before.step), 0.0)


@given(happenings, results)
@settings(max_examples=60, deadline=None)
def test_what_is_said_of_the_effect_is_so(happened, outcomes):
    ran = Ran(steps_of(happened), outcomes)
    about = {one.id: one for one in ran.decisions}
    for check in ran.checks:
        decision = about[check.decision]
        assert ran.outcomes[decision.id] in (Result.DONE, Result.DRY_RUN)
        if decision.reaction != "r.chain":
            continue
        state = ran.held[check.at_s][decision.entity].state
        if check.verification is Verification.GONE:
            assert state is State.OK
        elif check.verification is Verification.STILL_THERE:
            assert state.bad
        else:
            assert state in UNKNOWN


def look(reactor: Reactor, at: float, *verdicts: Verdict, **others: Any) -> list[Decision]:
    return reactor.look(Step(at, verdicts, **others), at)


def ready(start: float = 0.0) -> Reactor:
    reactor = Reactor(REACTIONS, start=start)
    for number in range(1, 61):
        look(reactor, start + number * 0.1)
    return reactor


def bad(at: float) -> Verdict:
    return verdict("topic:/t", State.ABSENT, "", at)


def test_nothing_in_the_first_seconds():
    reactor = Reactor(REACTIONS, start=0.0)
    assert look(reactor, 0.1, bad(0.1)) == []
    assert reactor.unwell == "the monitor has just begun"
    found = [one for number in range(2, 80) for one in look(reactor, number / 10)]
    assert [one.at_s for one in found] == [BEGINNING_S]


def test_nothing_before_all_observers_see():
    reactor = ready()
    assert look(reactor, 6.1, bad(6.1), begun=False) == []
    assert reactor.unwell == "observers do not see yet"
    assert len(look(reactor, 6.2)) == 1


@pytest.mark.parametrize(
    ("at", "others", "said"),
    [
        (9.0, {}, "the monitor looked 3.0 s after the look before"),
        (5.0, {}, "the monitor's clock was set back by 1.0 s"),
        (6.1, {"shed": 7}, "observers dropped 7 records"),
    ],
)
def test_nothing_while_the_monitor_is_not_well_and_everything_anew_afterwards(at, others, said):
    reactor = ready()
    assert look(reactor, at, bad(at), **others) == []
    assert reactor.unwell == said
    found = [one for number in range(1, 60) for one in look(reactor, at + number / 10, **others)]
    (one,) = found
    assert 2.9 <= one.at_s - at <= 5.1


def test_what_was_asked_for_long_ago_may_not_hold_any_more():
    reactor = ready()
    (decision,) = look(reactor, 6.1, bad(6.1))
    assert reactor.holds(decision.id) is True
    look(reactor, 6.2, verdict("topic:/t", State.UNKNOWN, "", 6.2))
    assert reactor.holds(decision.id) is None
    look(reactor, 6.3, verdict("topic:/t", State.OK, "", 6.3))
    assert reactor.holds(decision.id) is False
    assert reactor.holds("r.effects/99.0") is False


def test_an_answer_ends_what_was_asked():
    reactor = ready()
    (decision,) = look(reactor, 6.1, bad(6.1))
    reactor.reported(decision.id, Outcome(Result.ASKED))
    look(reactor, 6.2, verdict("topic:/t", State.OK, "", 6.2))
    assert reactor.checks() == []
    reactor.reported(decision.id, Outcome(Result.DONE))
    reactor.reported("nobody/1.0", Outcome(Result.DONE))
    look(reactor, 6.3)
    assert [(one.decision, one.verification) for one in reactor.checks()] == [(decision.id, Verification.GONE)]


def test_other_reactions_take_the_place_of_these():
    reactor = ready()
    (decision,) = look(reactor, 6.1, bad(6.1))
    reactor.reported(decision.id, Outcome(Result.DONE))
    reactor.replace([one for one in REACTIONS if one.name != "r.tree"])
    look(reactor, 6.2, verdict("topic:/t", State.OK, "", 6.2))
    assert [one.verification for one in reactor.checks()] == [Verification.GONE]
    reactor.replace([])
    assert look(reactor, 20.0, bad(20.0)) == []


def test_a_target_that_is_not_known_is_no_action_and_its_reason_is_told():
    text = (
        b"kind: reference\nname: r\nreactions:\n"
        b"- {id: a, settled: 0 s, when: {topic: /t, is: bad, effects: true}, do: [{restart: '{cause}'}]}"
    )
    (reaction,) = load_reference([GivenText("r.yaml", text)], BY_KEY).reactions
    reactor = Reactor([reaction], start=0.0)
    for number in range(1, 60):
        look(reactor, number / 10)
    assert look(reactor, 6.0, verdict("topic:/t", State.ABSENT, "host:h", 6.0)) == []
    assert reactor.withheld == {("r.a", ""): "`restart` of the first cause, which is host:h and no node"}
    (found,) = look(reactor, 6.1, verdict("topic:/t", State.ABSENT, "node:/n", 6.1))
    assert found.action.target == EntityId(EntityKind.NODE, "/n")


def stopping(text="stop", how="repeated", pattern="/t", before=""):
    stop = f"{{publish: {{topic: /stop, type: std_msgs/Bool, fields: {{data: true}}, how: {how}}}}}"
    when = f"{{topic: {pattern}, is: bad, effects: true}}"
    document = f"kind: reference\nname: r\nreactions:\n{before}- {{id: a, settled: 0 s, cool_down: 0 s, text: {text}, when: {when}, do: [{stop}]}}\n"  # noqa: E501
    return load_reference([GivenText("r.yaml", document.encode())], BY_KEY).reactions


def stopped(reactions):
    reactor = Reactor(reactions, start=0.0)
    for number in range(1, 60):
        look(reactor, number / 10)
    (found,) = look(reactor, 6.0, verdict("topic:/t", State.ABSENT, "", 6.0))
    reactor.reported(found.id, Outcome(Result.DONE))
    return reactor, found


def test_a_line_that_was_put_before_a_reaction_changes_nothing_of_it():
    reactor, found = stopped(stopping(how="once"))
    reactor.replace(stopping(how="once", before="# a stop\n"))
    assert look(reactor, 6.1) == []
    assert reactor.holds(found.id) is True


def test_a_stop_that_repeats_is_let_go_by_its_condition_and_not_by_an_edit():
    reactor, found = stopped(stopping())
    reactor.replace(stopping(text="halt", pattern="/u"))
    assert look(reactor, 6.1) == []
    assert reactor.holds(found.id) is True
    look(reactor, 6.2, verdict("topic:/t", State.OK, "", 6.2))
    assert [one.verification for one in reactor.checks()] == [Verification.GONE]
    (other,) = look(reactor, 6.3, verdict("topic:/u", State.ABSENT, "", 6.3))
    assert other.text == "halt"


def test_a_stop_that_was_taken_out_of_the_document_ends():
    reactor, found = stopped(stopping())
    reactor.replace([])
    look(reactor, 6.1)
    assert reactor.holds(found.id) is False


def holding(states):
    text = f"kind: reference\nname: r\nreactions:\n- {{id: a, settled: 0 s, when: {{topic: /t, is: {states}, effects: true, for: 1 s}}, do: [{{snapshot: {{}}}}]}}\n"  # noqa: E501
    reactor = Reactor(load_reference([GivenText("r.yaml", text.encode())], BY_KEY).reactions, start=0.0)
    for number in range(1, 60):
        look(reactor, number / 10)
    return reactor


def test_silence_that_is_told_late_counts_from_when_it_began():
    assert len(look(holding("absent"), 6.0, verdict("topic:/t", State.ABSENT, "", 4.9))) == 1
    reactor = holding("absent")
    assert look(reactor, 6.0, verdict("topic:/t", State.ABSENT, "", 5.5)) == []
    assert look(reactor, 6.4) == []
    assert len(look(reactor, 6.5)) == 1


def test_a_value_over_its_bound_counts_from_when_it_was_told():
    reactor = holding("bad")
    assert look(reactor, 6.0, verdict("topic:/t", State.LOW, "", 4.0)) == []
    assert look(reactor, 6.9) == []
    assert len(look(reactor, 7.0)) == 1


def test_silence_does_not_count_while_the_monitor_was_not_well():
    reactor = holding("absent")
    # It slept for longer than its conditions may be believed.
    assert look(reactor, 60.0, verdict("topic:/t", State.ABSENT, "", 6.0)) == []
    assert reactor.unwell
