"""The steps of an answer that source gives."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.compare.why.declared import MAKERS, Declared, ends_named, ends_of
from roslens.compare.why.fit import Placed, qos_fit, type_fit
from roslens.compare.why.makers import source_exists, source_makers, source_users
from roslens.compare.why.question import Question, near_names
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.configuration import ConfiguredNode
from roslens.model.finding import Severity
from roslens.model.graph import Role
from roslens.model.graphs.end import KIND

_MOST = 6
_SHOWN_ELSEWHERE = frozenset({"graph.qos", "graph.type", "graph.one_end"})


def steps_of_source(question: Question, declared: Declared) -> Iterator[Step]:
    """Yield what source says of an entity; nothing of a frame, a transform or a host."""
    if question.kind in MAKERS:
        yield from _of_ends(question, declared)
    elif question.kind == "node":
        yield from _of_node(question, declared)


def _of_ends(question: Question, declared: Declared) -> Iterator[Step]:
    exists = source_exists(question, declared)
    yield exists
    ends = ends_named(declared.configuration, question.kind, question.name)
    if not ends:
        return
    yield source_makers(question, declared)
    yield source_users(question, declared)
    placed = [Placed(one.one.endpoint, one.one.proof.place, bool(one.one.qos_unknown)) for one in ends]
    yield from (one for one in (type_fit(placed, "source"), qos_fit(placed, "source")) if one is not None)
    names = {question.entity, *(f"node:{one.node.name}" for one in ends)}
    yield from _of_rules(declared, names)


def _of_rules(declared: Declared, entities: set[str]) -> Iterator[Step]:
    found = [
        one for one in declared.findings
        if one.entity in entities and one.severity is not Severity.NOTE and one.rule not in _SHOWN_ELSEWHERE
    ]  # fmt: skip
    if found:
        found.sort(key=lambda one: -one.severity.rank)
        lines = tuple(f"{one.path}:{one.line}: {one.message} [{one.rule}]" for one in found[:_MOST])
        says = f"{len(found)} finding{'s' * (len(found) > 1)} of the rules on it and its nodes"
        yield Step(Asks.RULES, StepState.NOT, says, "source", lines, command=f"roslens explain {found[0].rule}")


def _of_node(question: Question, declared: Declared) -> Iterator[Step]:
    nodes = [one for one in declared.configuration.nodes if one.name == question.name]
    if not nodes:
        yield _not_started(question, declared)
        return
    node = nodes[0]
    if len(nodes) > 1:
        says = f"{declared.title} starts {len(nodes)} nodes of this name: the middleware keeps only one reachable"
        places = tuple(f"{one.package}/{one.executable}: {one.proof.place}" for one in nodes[:_MOST])
        yield Step(Asks.EXISTS, StepState.NOT, says, "source", places, "give each its own name or namespace")
    else:
        yield Step(Asks.EXISTS, StepState.OK, f"{declared.title} has it", "source", _places(node))
    yield _started(node)
    yield from _inputs(node, declared)
    yield from _of_rules(declared, {question.entity})


def _places(node: ConfiguredNode) -> tuple[str, ...]:
    lines = [f"{node.package}/{node.executable}, started at {node.proof.place}" if node.package else node.proof.place]
    if node.defined is not None and node.defined.place:
        lines.append(f"its code: {node.defined.place}")
    return tuple(lines)


def _not_started(question: Question, declared: Declared) -> Step:
    for other in declared.elsewhere:
        for node in other.configuration.nodes:
            if node.name == question.name:
                says = f"{declared.title} does not start it: {other.how}"
                return Step(Asks.EXISTS, StepState.NOT, says, "source", _places(node), command=other.command)
    near = near_names(question.name, {one.name for one in declared.configuration.nodes})
    how = f"nearest names: {', '.join(near)}" if near else ""
    says = f"nothing in {declared.title} is called {question.name}"
    return Step(Asks.EXISTS, StepState.NOT, says, "source", how=how, command=declared.command)


def _started(node: ConfiguredNode) -> Step:
    if node.conditions:
        needs = " and ".join(f"`{one}`" for one in node.conditions)
        return Step(Asks.MADE, StepState.UNSEEN, f"it is started only if {needs}", "source", _places(node),
                    "whether that holds is known only when it is started")  # fmt: skip
    kinds = {"lifecycle": "a managed node, which makes its endpoints when it is configured and activated",
             "component": f"a component, loaded into {node.container or 'a container'}",
             "nodelet": f"a nodelet, loaded into {node.container or 'its manager'}"}  # fmt: skip
    what = f": {kinds[node.kind]}" if node.kind in kinds else ""
    return Step(Asks.MADE, StepState.OK, f"it is started without a condition{what}", "source", _places(node))


def _inputs(node: ConfiguredNode, declared: Declared) -> Iterator[Step]:
    """Yield whether somebody makes what the node waits for."""
    made = {(KIND[one.role], one.name) for one in ends_of(declared.configuration, implicit=True) if one.role in _MAKING}
    waits = [one for one in node.endpoints if one.endpoint.role not in _MAKING and one.resolved and not one.implicit]
    lacking = [one for one in waits if (KIND[one.endpoint.role], one.endpoint.name) not in made]
    if not waits:
        return
    if not lacking:
        yield Step(
            Asks.INPUTS, StepState.OK, f"all {len(waits)} names that it waits on are made by some node", "source"
        )
        return
    lines = tuple(f"{one.endpoint.name}: {one.proof.place}" for one in lacking[:_MOST])
    says = f"nobody that is known makes {len(lacking)} of the {len(waits)} names that it waits on"
    yield Step(
        Asks.INPUTS, StepState.UNSEEN, says, "source", lines, "ask for each of them",
        f"roslens why {lacking[0].endpoint.name}",
    )  # fmt: skip


_MAKING = frozenset({Role.PUBLISHER, Role.SERVICE_SERVER, Role.ACTION_SERVER})
