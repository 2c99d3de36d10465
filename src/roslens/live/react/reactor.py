"""Decides what is due: reactions over what is known of a system. Pure: time, steps and outcomes are arguments."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence

import msgspec

from roslens.judge.reference.template import filled, filled_in
from roslens.live.join.session import Step
from roslens.live.react.chain import Chain, Stage
from roslens.live.react.evaluation import Chosen
from roslens.live.react.known import Known
from roslens.live.react.plan import Plan
from roslens.live.react.truth import Truth
from roslens.live.react.value_words import value_words
from roslens.live.react.wellness import Wellness
from roslens.live.window.newest import keep_newest
from roslens.model.acting.process_end import end_words, in_order
from roslens.model.acting.reaction import (
    ActionCall,
    Because,
    Checked,
    Decision,
    EscalationStep,
    Outcome,
    Reaction,
    essence,
    repeats,
)
from roslens.model.entity import EntityId

MOST_ENDED = 1_000
_BEGINS = frozenset({"restart", "start"})
_ENDS = frozenset({"restart", "stop", "kill"})
_FORWARDING = {"{entity}", "{host}", "{cause}"}


class Reactor:
    """Determines which actions are due, and whether those that were carried out helped.

    Attributes:
        unwell: why nothing is decided, because of the monitor itself; empty where it is fit to.
        withheld: why a reaction whose condition is true does nothing, by its name and the entity.
        spared: the part of it that is about nodes which somebody ended in order.
    """

    def __init__(self, reactions: Sequence[Reaction], *, start: float) -> None:
        """Begin at ``start``, in seconds on the monitor's clock."""
        self.unwell = ""
        self.withheld: dict[tuple[str, str], str] = {}
        self.spared: dict[tuple[str, str], str] = {}
        self._ended_by_us: dict[str, float] = {}
        self._start = start
        self._now = start
        self._known = Known(start)
        self._chosen = Chosen(self._known)
        self._wellness = Wellness(start)
        self._plans = [Plan(one, self._known, self._chosen, start) for one in sorted(reactions, key=lambda r: r.name)]
        self._chains: dict[tuple[str, EntityId | None], Chain] = {}
        self._by_decision: dict[str, tuple[str, EntityId | None]] = {}
        self._latest: dict[tuple[str, EntityId | None], float] = {}
        self._recent: dict[str, deque[float]] = {}
        self._number = 0
        self._checks: list[Checked] = []
        self._follow: dict[str, Reaction] = {}

    def look(self, step: Step, now_s: float) -> list[Decision]:
        """Take a step of the session; return what is due, by reaction and entity."""
        self._now = now_s
        self._known.take(step, now_s)
        self.unwell = self._wellness.look(step, now_s)
        self.withheld, self.spared = {}, {}
        if self._follow:
            self._renew()
        if self.unwell:
            for plan in self._plans:
                plan.forget()
            return []
        return [
            decision for plan in self._plans for one in self._entities(plan) for decision in self._consider(plan, one)
        ]

    def reported(self, decision_id: str, outcome: Outcome) -> None:
        """Take what became of a decision; unknown decisions are none of ours any more."""
        key = self._by_decision.get(decision_id)
        chain = self._chains.get(key) if key is not None else None
        if chain is not None and chain.latest is not None and chain.latest.id == decision_id:
            chain.reported(outcome, self._now)

    def checks(self) -> list[Checked]:
        """Return what was found out since the last time about whether actions helped."""
        found, self._checks = self._checks, []
        return found

    def holds(self, decision_id: str) -> Truth:
        """Return whether the cause of a decision is still there: what was asked for long ago may be done no more."""
        key = self._by_decision.get(decision_id)
        plan = next((one for one in self._plans if key is not None and one.reaction.name == key[0]), None)
        if key is None or plan is None or key not in self._chains:
            return False
        return None if self.unwell else plan.lasts(key[1])

    def replace(self, reactions: Sequence[Reaction]) -> None:
        """Go on with other reactions.

        Those that say the same keep their chains and hold times, and one that repeats a message at the moment stays as
        it was until its condition is false: to edit a constraint lets no robot go that was stopped.
        """
        before = {plan.reaction.name: plan for plan in self._plans}
        after = []
        self._follow = {}
        for reaction in sorted(reactions, key=lambda one: one.name):
            plan = before.get(reaction.name)
            if plan is not None and essence(plan.reaction) != essence(reaction):
                if self._repeats(plan):
                    self._follow[reaction.name] = reaction
                else:
                    plan = None
            after.append(plan or Plan(reaction, self._known, self._chosen, self._start))
        kept = {id(plan) for plan in after}
        dropped = {name for name, plan in before.items() if id(plan) not in kept}
        self._chains = {key: chain for key, chain in self._chains.items() if key[0] not in dropped}
        self._plans = after

    def _renew(self) -> None:
        """Let reactions that had to wait for an end take the place of what they are a change of."""
        for place, plan in enumerate(self._plans):
            reaction = self._follow.get(plan.reaction.name)
            if reaction is not None and not self._repeats(plan):
                del self._follow[reaction.name]
                self._chains = {key: one for key, one in self._chains.items() if key[0] != reaction.name}
                self._plans[place] = Plan(reaction, self._known, self._chosen, self._start)

    def _repeats(self, plan: Plan) -> bool:
        """Whether a chain of a reaction has come to a message that is repeated until its condition is false."""
        repeated = [number for number, step in enumerate(plan.reaction.steps) if repeats(step.action)]
        chains = [chain for key, chain in self._chains.items() if key[0] == plan.reaction.name]
        return any(chain.step >= number for chain in chains for number in repeated)

    def _entities(self, plan: Plan) -> list[EntityId | None]:
        """Return what a reaction is about: each entity that is chosen, and those of chains that go on."""
        if plan.each is None:
            return [None]
        going = {one for name, one in self._chains if name == plan.reaction.name and one is not None}
        chosen: Iterable[EntityId] = self._chosen.of(plan.each.selector)
        if plan.only_suspects:
            # Most of what a pattern chooses is fine: it is not looked at ten times a second.
            suspects = (one for one in chosen if self._known.suspect(one))
            chosen = (*suspects, *plan.tracked())
        return [*sorted({*chosen, *going})]

    def _consider(self, plan: Plan, entity: EntityId | None) -> list[Decision]:
        key = (plan.reaction.name, entity)
        truth, shows = plan.truth(entity)
        chain = self._chains.get(key)
        if chain is None:
            if truth is not True:
                return []
            return self._begin(plan, entity, shows)
        lasts = plan.lasts(entity)
        if lasts is False and chain.stage is not Stage.WAITING:
            self._checks += chain.ended(self._now)
            del self._chains[key]
            return []
        self._checks += chain.verify(lasts, self._now)
        if chain.stage is not Stage.DUE or truth is not True:
            return []
        return self._decide(plan, entity, chain, shows)

    def _begin(self, plan: Plan, entity: EntityId | None, shows: tuple[Because, ...]) -> list[Decision]:
        key = (plan.reaction.name, entity)
        latest = self._latest.get(key)
        wait = 0.0 if latest is None else latest + plan.reaction.cool_down_s - self._now
        if wait > 0:
            self._withhold(key, "cools down")
            return []
        self._number += 1
        chain = Chain(self._number, plan.reaction.steps)
        decisions = self._decide(plan, entity, chain, shows)
        if decisions:
            self._chains[key] = chain
        return decisions

    def _decide(self, plan: Plan, entity: EntityId | None, chain: Chain, shows: tuple[Because, ...]) -> list[Decision]:
        reaction = plan.reaction
        key = (reaction.name, entity)
        recent = self._recent.setdefault(reaction.name, deque())
        while recent and recent[0] <= self._now - reaction.per_s:
            recent.popleft()
        if reaction.at_most and len(recent) >= reaction.at_most:
            self._withhold(key, f"at most {reaction.at_most} in {reaction.per_s:g} s")
            return []
        about = self._about(plan, entity, shows)
        cause = self._first_cause(shows, about)
        values = self._values(reaction, about, cause, shows, chain.step + 1)
        action = self._filled(chain.next, values, cause)
        if isinstance(action, str):
            self._withhold(key, action)
            return []
        if why := self._ended_in_order(action):
            self._withhold(key, why)
            self.spared[key[0], str(key[1] or "")] = why
            return []
        if action.kind in _ENDS and action.target is not None:
            self._ended_by_us[action.target.name] = self._now
            keep_newest(self._ended_by_us)
        decision = Decision(
            id=f"{reaction.name}/{chain.number}.{chain.step + 1}",
            reaction=reaction.name,
            entity=about,
            step=chain.step + 1,
            action=action,
            at_s=self._now,
            because=shows,
            first_cause=cause,
            since=min((one.since for one in shows), default=self._now),
            mode=reaction.mode,
            text=filled(reaction.text, values),
            place=action.place,
        )
        chain.decided(decision)
        recent.append(self._now)
        self._latest[key] = self._now
        self._by_decision[decision.id] = key
        while len(self._by_decision) > MOST_ENDED:
            del self._by_decision[next(iter(self._by_decision))]
        return [decision]

    def _withhold(self, key: tuple[str, EntityId | None], reason: str) -> None:
        self.withheld[key[0], str(key[1] or "")] = reason

    def _ended_in_order(self, action: ActionCall) -> str:
        """Return why a node stays ended: somebody else asked it to end, or it was done; empty for any other."""
        target = action.target
        if action.kind not in _BEGINS or target is None or action.arguments.get("after_orderly_end"):
            return ""
        ended = self._known.presences.end_of(target)
        if ended is None or not ended.in_order:
            return ""
        began, by_us = self._known.presences.began(target), self._ended_by_us.get(target.name)
        if by_us is not None and (began is None or began <= by_us):
            return ""
        known = in_order(ended.how) is not None
        how = end_words(ended.how) if known else "it took its leave before its process ended"
        return f"{target.name} was ended in order ({how}), not by a fault, and stays so"

    def _about(self, plan: Plan, entity: EntityId | None, shows: tuple[Because, ...]) -> str:
        if entity is not None:
            return str(entity)
        if plan.bound is not None:
            return str(EntityId(plan.bound.selector.kind, plan.bound.selector.name))
        chosen = [str(one) for stated in plan.statements for one in self._chosen.of(stated.selector)]
        shown = {one.entity for one in shows}
        return next((one for one in chosen if one in shown), shows[0].entity if shows else "")

    def _first_cause(self, shows: tuple[Because, ...], about: str) -> str:
        """Return who is to blame for the first thing that is bad, what the reaction is about before others."""
        for one in sorted(shows, key=lambda one: (one.entity != about, one.entity)):
            for held in self._known.verdicts(EntityId.parse(one.entity)):
                verdict = held.verdict
                if verdict.expectation == one.expectation and verdict.state.bad:
                    return verdict.cause or one.entity
            if not one.expectation and one.state in ("gone", "crashed", "stopped", "hung", "misfit"):
                return one.entity
        return ""

    def _values(
        self, reaction: Reaction, about: str, cause: str, shows: tuple[Because, ...], step: int
    ) -> dict[str, str]:
        entity = EntityId.parse(about) if about else None
        shown = next((one for one in shows if one.entity == about), shows[0] if shows else None)
        known = {
            "entity": entity.name if entity else "",
            "kind": entity.kind.value if entity else "",
            "host": self._known.host_of(entity) if entity else "",
            "cause": cause.partition(":")[2],
            "reaction": reaction.name,
            "step": str(step + 1),
        }
        if shown is None:
            return known
        return {
            **known,
            "state": shown.state,
            "signal": shown.quantity,
            "value": value_words(shown.value, shown.quantity),
            "since": f"{max(self._now - shown.since, 0.0):.1f}",
            "evidence": shown.evidence,
        }

    def _filled(self, step: EscalationStep, values: dict[str, str], cause: str) -> ActionCall | str:
        """Return an action with its templates filled, or why that cannot be."""
        call = step.action
        target = call.target
        if target is not None and target.name in _FORWARDING:
            field = target.name.strip("{}")
            name = values.get(field, "")
            if not name:
                return f"`{call.kind}` of {target.name}, which is unknown"
            if field == "cause" and EntityId.parse(cause).kind is not target.kind:
                return f"`{call.kind}` of the first cause, which is {cause} and no {target.kind.value}"
            target = EntityId(target.kind, name)
        return msgspec.structs.replace(call, target=target, arguments=filled_in(call.arguments, values))
