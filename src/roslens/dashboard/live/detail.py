"""All that is known of one entity at one instant: what the live page shows of the row that was chosen."""

from __future__ import annotations

import msgspec


class Value(msgspec.Struct, frozen=True):
    """A signal: its key, its title, its latest value as people read it, and what it means."""

    key: str
    title: str
    shown: str
    text: str


class Judgement(msgspec.Struct, frozen=True, omit_defaults=True):
    """The verdict of one constraint on the entity.

    Attributes:
        expectation: id of the constraint.
        title: of the signal that is judged.
        value: that was judged, as people read it; empty where there is none.
        expected: the range, as the reference has it.
        state: how it stands.
        severity: of its being broken.
        since: when the state began, as people read it.
        evidence: what shows it.
        cause: text form of the id of what explains it.
        leads_to: what follows from it.
        why: the way to the cause, in words.
        text: message for the operator.
        where: ``file:line`` of the constraint.
    """

    expectation: str
    title: str
    value: str
    expected: str
    state: str
    severity: str
    since: str
    evidence: str = ""
    cause: str = ""
    leads_to: str = ""
    why: str = ""
    text: str = ""
    where: str = ""


class Detail(msgspec.Struct, frozen=True, omit_defaults=True):
    """One entity.

    Attributes:
        entity: text form of its id.
        name: to show.
        kind: of it.
        when: the instant, as people read it.
        observed: how its values are observed, in words; empty where there are none.
        judgements: its verdicts by constraint, the worst first.
        values: all its signals.
        below: what is wrong below it, in words.
    """

    entity: str
    name: str
    kind: str
    when: str
    observed: str = ""
    judgements: tuple[Judgement, ...] = ()
    values: tuple[Value, ...] = ()
    below: str = ""
