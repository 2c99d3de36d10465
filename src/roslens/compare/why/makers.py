"""Who should make what a topic, service or action carries, by source; and if nobody does, why."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.compare.why.declared import MAKERS, Declared, ends_named, ends_of, open_ends, unread_nodes
from roslens.compare.why.question import Question, near_names
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.graph import Role
from roslens.model.graphs.end import KIND, VERB, End, verb_of

_MOST = 6
_USERS = {Role.PUBLISHER: Role.SUBSCRIPTION, Role.SERVICE_SERVER: Role.SERVICE_CLIENT,
          Role.ACTION_SERVER: Role.ACTION_CLIENT}  # fmt: skip
_NOUN = {
    Role.PUBLISHER: "publisher", Role.SUBSCRIPTION: "subscription",
    Role.SERVICE_SERVER: "server", Role.SERVICE_CLIENT: "client",
    Role.ACTION_SERVER: "server", Role.ACTION_CLIENT: "client",
}  # fmt: skip


def source_exists(question: Question, declared: Declared) -> Step:
    """Return whether source has the entity at all."""
    ends = ends_named(declared.configuration, question.kind, question.name)
    if ends:
        counts = [(_NOUN[role], sum(one.role is role for one in ends)) for role in Role]
        said = ", ".join(f"{count} {noun}{'s' * (count > 1)}" for noun, count in counts if count)
        return Step(Asks.EXISTS, StepState.OK, f"{declared.title} has {said} of it", "source")
    for other in declared.elsewhere:
        if found := ends_named(other.configuration, question.kind, question.name):
            return Step(
                Asks.EXISTS, StepState.NOT, f"nothing that {declared.title} starts uses it; {other.how}", "source",
                tuple(one.line for one in found[:_MOST]), command=other.command,
            )  # fmt: skip
    near = near_names(question.name, {one.name for one in ends_of(declared.configuration)})
    return Step(
        Asks.EXISTS, StepState.NOT, f"nothing in {declared.title} is called {question.name}", "source",
        how=f"nearest names: {', '.join(near)}" if near else "", command=declared.command,
    )  # fmt: skip


def source_makers(question: Question, declared: Declared) -> Step:
    """Return who publishes or serves it by source; if nobody does, the likeliest reason."""
    role = MAKERS[question.kind]
    return _side(question, declared, role, Asks.MADE)


def source_users(question: Question, declared: Declared) -> Step:
    """Return who subscribes to it or calls it by source; if nobody does, the likeliest reason."""
    role = _USERS[MAKERS[question.kind]]
    return _side(question, declared, role, Asks.USED)


def _side(question: Question, declared: Declared, role: Role, asks: Asks) -> Step:
    ends = [one for one in ends_named(declared.configuration, question.kind, question.name) if one.role is role]
    certain = [one for one in ends if not one.conditions]
    lines = tuple(one.line for one in (certain or ends)[:_MOST])
    noun = _NOUN[role]
    if certain:
        names = ", ".join(dict.fromkeys(one.node.name for one in certain))
        return Step(asks, StepState.OK, f"{names} {verb_of(role, names.count(',') + 1)} it", "source",
                    lines)  # fmt: skip
    if ends:
        needs = " and ".join(f"`{text}`" for text in ends[0].conditions)
        return Step(
            asks, StepState.UNSEEN, f"{ends[0].node.name} {VERB[role]} it only if {needs}", "source", lines,
            how="whether that holds is known only when it is started",
        )  # fmt: skip
    for reason in _reasons(question, declared, role):
        return _absent(reason, asks, noun, declared)
    unknown = unread_nodes(declared.configuration)
    if unknown:
        names = ", ".join(one.name for one in unknown[:_MOST])
        return Step(
            asks, StepState.UNSEEN, f"no {noun} of it is known, but what {names} use is unknown", "source",
            tuple(f"{one.name}: {one.package}/{one.executable} ({one.proof.place})" for one in unknown[:_MOST]),
            how="their code is not in the workspace: look while they run",
            command=f"roslens why {question.name} --live",
        )  # fmt: skip
    opening = [one for one in declared.configuration.unresolved if one.opens]
    if opening:
        return Step(
            asks, StepState.UNSEEN, f"no {noun} of it is known, but not all that {declared.title} starts", "source",
            tuple(f"{one.proof.place}: {one.reason}" for one in opening[:_MOST]), command=declared.command,
        )  # fmt: skip
    return _nobody(declared, role, asks)


def _nobody(declared: Declared, role: Role, asks: Asks) -> Step:
    """Return that there is no other end; that nobody uses what is made keeps nothing from being made."""
    verb = VERB[role].removesuffix(" to")
    if asks is Asks.USED:
        return Step(asks, StepState.UNSEEN, f"no {_NOUN[role]} of it is known in the source", "source",
                    how="somebody outside of the workspace may use it")  # fmt: skip
    # What packages make without a launch file does not have to run alone.
    state = StepState.NOT if declared.launched else StepState.UNSEEN
    return Step(
        asks, state, f"no node of {declared.title} {verb} it, and nothing in the workspace does", "source",
        how="start what provides it, or correct the name", command=declared.command,
    )  # fmt: skip


class _Reason(msgspec.Struct, frozen=True):
    """Why there is no other end: in a sentence, the ends that show it, how it is corrected, and a command to try."""

    says: str
    ends: tuple[End, ...]
    how: str = ""
    command: str = ""
    state: StepState = StepState.NOT


def _absent(reason: _Reason, asks: Asks, noun: str, declared: Declared) -> Step:
    return Step(
        asks, reason.state, f"no {noun} of it in {declared.title}: {reason.says}", "source",
        tuple(one.line for one in reason.ends[:_MOST]), reason.how, reason.command,
    )  # fmt: skip


def _reasons(question: Question, declared: Declared, role: Role) -> Iterator[_Reason]:
    """Yield why there is no end of a role, the surest reason first."""
    every = [one for one in ends_of(declared.configuration) if one.role is role]
    yield from _remapped(question.name, every)
    yield from _elsewhere(question, declared, role)
    yield from _near(question, declared, role, every)
    for one in open_ends(declared.configuration, question.kind, question.name):
        if one.role is role:
            yield _Reason(
                f"{one.node.name} {VERB[role]} {one.name}, of which a part is known only when it runs",
                (one,),
                "look at the parameter or argument that gives the name",
                state=StepState.UNSEEN,
            )


def _remapped(name: str, every: Sequence[End]) -> Iterator[_Reason]:
    for one in every:
        if one.one.remapped is not None and one.own_name == name:
            yield _Reason(
                f"{one.node.name} is remapped from {name} to {one.name} at {one.one.remapped.place}",
                (one,),
                f"remove the remapping, or let the other side use {one.name}",
            )


def _elsewhere(question: Question, declared: Declared, role: Role) -> Iterator[_Reason]:
    # Who listens may be started by hand: only who makes it is missed for certain.
    is_maker = role is MAKERS[question.kind]
    for other in declared.elsewhere:
        ends = [one for one in ends_named(other.configuration, question.kind, question.name) if one.role is role]
        if ends:
            state = StepState.NOT if is_maker and not other.loose else StepState.UNSEEN
            yield _Reason(other.how, tuple(ends), command=other.command, state=state)


def _near(question: Question, declared: Declared, role: Role, every: Sequence[End]) -> Iterator[_Reason]:
    """Yield the ends of nearly the same name that have no other side either."""
    ends = ends_named(declared.configuration, question.kind, question.name)
    types = {one.one.endpoint.type for one in ends if one.one.endpoint.type}
    fit = {one.name: one for one in every if not types or one.one.endpoint.type in {*types, ""}}
    fed = {
        one.name for one in ends_of(declared.configuration) if one.role is not role and KIND[one.role] == question.kind
    }
    for near in near_names(question.name, fit):
        if near not in fed:
            yield _Reason(
                f"{fit[near].node.name} {VERB[role]} {near}, which nobody else uses",
                (fit[near],),
                f"correct or remap one of the two names: {near} and {question.name}",
            )
