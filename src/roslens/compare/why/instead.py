"""Who makes the same under another name: a remapping, a namespace or a typing error on one of two sides."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from roslens.compare.why.declared import MAKERS
from roslens.compare.why.observed import Observed
from roslens.compare.why.question import Question, near_names
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.configuration import ConfiguredEndpoint, ConfiguredNode
from roslens.model.graph import Endpoint
from roslens.model.graphs.end import KIND, OTHER, VERB


def made_instead(question: Question, wanted: Sequence[ConfiguredNode], observed: Observed) -> Step | None:
    """Return what a node that should make it makes instead, by its source; None where none does.

    It is the end of the same role and type that the running node has and its source does not.
    """
    for node in wanted:
        own = {one.endpoint.name: one for one in node.endpoints if one.endpoint.role is MAKERS[question.kind]}
        end = own.get(question.name)
        other = None if end is None else _surplus(node.name, end.endpoint, own, observed)
        if end is not None and other is not None:
            return _instead(node, end, other, observed.graph.generation)
    return None


def _surplus(node: str, end: Endpoint, own: Collection[str], observed: Observed) -> Endpoint | None:
    """Return what a node makes of the role and type of ``end`` that its source has not."""
    return next(
        (one for one in observed.graph.endpoints
         if (one.node, one.role) == (node, end.role) and one.name not in own and _same_type(one.type, end.type)),
        None,
    )  # fmt: skip


def _instead(node: ConfiguredNode, end: ConfiguredEndpoint, other: Endpoint, generation: str) -> Step:
    verb = VERB[other.role]
    says = f"{node.name}, which should make it, {verb} {other.name} instead"
    lines = [f"by its source {node.name} {verb} {end.endpoint.name}: {end.proof.place}"]
    if node.proof.place:
        lines.append(f"started at {node.proof.place}")
    how = f"correct the remapping or the name where {node.name} is started, or let the other side use it"
    command = f"ros2 node info {node.name}" if generation == "ros2" else f"rosnode info {node.name}"
    return Step(Asks.MADE, StepState.NOT, says, "live", tuple(lines), how, command)


def made_nearly(question: Question, users: Sequence[Endpoint], observed: Observed) -> Step | None:
    """Return who makes the same type under nearly the same name for nobody; None where nobody does."""
    role = MAKERS[question.kind]
    types = {one.type for one in users}
    of_kind = [one for one in observed.graph.endpoints if KIND[one.role] == question.kind]
    makers = {one.name: one for one in of_kind if one.role is role and any(_same_type(one.type, of) for of in types)}
    used = {one.name for one in of_kind if one.role is OTHER[role]}
    for near in near_names(question.name, makers):
        if near not in used:
            one = makers[near]
            says = f"{one.node} {VERB[role]} {near}, which nobody else uses"
            how = f"correct or remap one of the two names: {near} and {question.name}"
            lines = (f"both have {one.type}",) if one.type else ()
            return Step(Asks.MADE, StepState.NOT, says, "live", lines, how)
    return None


def _same_type(one: str, other: str) -> bool:
    return one == other or not one or not other
