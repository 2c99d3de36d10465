"""The plan: the reactions of a reference to faults, and the outcome of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.dashboard.journal.journal_view import JournalRow
from roslens.judge.reference.condition_words import condition_words
from roslens.model.acting.reaction import EscalationStep, Reaction
from roslens.report.history.journal_text import action_text


class Countermeasure(msgspec.Struct, frozen=True, omit_defaults=True):
    """A reaction of the reference in words.

    Attributes:
        name: ``<document>.<id>``.
        when: what has to be the case.
        limits: what else has to be, or must not be, and how often it is done at most.
        steps: what is done, the next where the one before did not help.
        mode: what decisions lead to, if the reaction sets it.
        text: what the operator reads.
        where: ``file:line:column``.
        decided: how many decisions of it the journal has.
        last: the newest entry about one of them.
    """

    name: str
    when: str
    limits: tuple[str, ...]
    steps: tuple[str, ...]
    mode: str = ""
    text: str = ""
    where: str = ""
    decided: int = 0
    last: JournalRow | None = None


def plan_of(reactions: Sequence[Reaction], decided: Mapping[str, tuple[int, JournalRow]]) -> tuple[Countermeasure, ...]:
    """Return reactions in the order of their documents; ``decided`` has by name how often, and the newest entry."""
    return tuple(_countermeasure(one, *decided.get(one.name, (0, None))) for one in reactions)


def _countermeasure(one: Reaction, count: int, last: JournalRow | None) -> Countermeasure:
    steps = tuple(_step(step, last=step is one.steps[-1]) for step in one.steps)
    return Countermeasure(
        one.name, condition_words(one.when), tuple(_limits(one)), steps,
        one.mode.value if one.mode else "", one.text, one.place, count, last,
    )  # fmt: skip


def _limits(one: Reaction) -> list[str]:
    found = []
    if one.only_while is not None:
        found.append(f"only while {condition_words(one.only_while)}")
    if one.unless is not None:
        found.append(f"not while {condition_words(one.unless)}")
    if one.settled_s:
        found.append(f"only once the first cause has been the same for {one.settled_s:g} s")
    if one.cool_down_s:
        found.append(f"for the same entity again after {one.cool_down_s:g} s at the earliest")
    if one.at_most:
        found.append(f"at most {one.at_most} in {one.per_s:g} s")
    return found


def _step(step: EscalationStep, *, last: bool) -> str:
    action = action_text(msgspec.to_builtins(step.action))
    if step.verify_within_s is None:
        return action
    then = "it is given up" if last else "the next step follows"
    return f"{action}; if that does not help within {step.verify_within_s:g} s, {then}"
