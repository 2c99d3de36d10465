"""The steps of an answer that a running system gives: who is there, who is missing, does it arrive."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.compare.why.apart import reached
from roslens.compare.why.declared import MAKERS, Declared, ends_named
from roslens.compare.why.fit import Placed, qos_fit, type_fit
from roslens.compare.why.instead import made_instead, made_nearly
from roslens.compare.why.observed import Observed
from roslens.compare.why.of_transform import steps_of_heard
from roslens.compare.why.question import TRANSFORM, Question, near_names
from roslens.compare.why.simulated_clock import clock_missing
from roslens.compare.why.users import kept_apart_by_user
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.configuration import ConfiguredNode
from roslens.model.graph import Endpoint, Node, Role
from roslens.model.graphs.end import KIND, VERB, verb_of

_MOST = 6
_NOT_ACTIVE = {
    "unconfigured": "it makes its publishers when it is configured",
    "inactive": "it publishes when it is activated",
    "finalized": "it has ended its work",
    "errorprocessing": "it handles an error",
}


def steps_of_live(question: Question, observed: Observed, declared: Declared | None) -> Iterator[Step]:
    """Yield what a running system says of an entity; ``declared`` tells who should make it."""
    if question.kind in MAKERS:
        yield from _of_ends(question, observed, declared)
    elif question.kind == "node":
        yield from _of_node(question, observed, declared)
    elif question.kind in ("frame", TRANSFORM):
        yield from steps_of_heard(question, observed)


def _of_ends(question: Question, observed: Observed, declared: Declared | None) -> Iterator[Step]:
    ends = [
        one for one in observed.graph.endpoints if one.name == question.name and KIND[one.role] == question.kind
    ]  # fmt: skip
    makers = [one for one in ends if one.role is MAKERS[question.kind]]
    wanted = _wanted(question, declared)
    users = [one for one in ends if one.role is not MAKERS[question.kind]]
    if users:
        yield Step(Asks.USED, StepState.OK, _who_does(users), "live")
    runs, missing = _runs([one.node for one in makers], wanted, observed)
    apart = reached(observed, _programs(missing), question.name)
    yield _exists(question, ends, observed, apart)
    instead = made_instead(question, wanted, observed)
    nearly = made_nearly(question, users, observed)
    yield _makers(question, makers, observed, [one for one in (apart, instead, *runs, nearly) if one is not None])
    yield from runs
    if apart is not None:
        yield apart
    if (by_user := kept_apart_by_user(ends, observed)) is not None:
        yield by_user
    placed = [Placed(one) for one in ends]
    yield from (one for one in (type_fit(placed, "live"), qos_fit(placed, "live")) if one is not None)
    if question.kind == "topic":
        yield from _traffic(question, observed, has_makers=bool(makers))


def _programs(nodes: Sequence[ConfiguredNode]) -> dict[str, str]:
    """Return what command lines of nodes have in them: the executable, and the name that is given at the start."""
    return {
        word: one.name for one in nodes for word in (one.executable, f"__node:={one.name.rpartition('/')[2]}") if word
    }


def _wanted(question: Question, declared: Declared | None) -> list[ConfiguredNode]:
    """Return the nodes that make an entity by source: those that are surely started, else any."""
    if declared is None:
        return []
    for one in (declared.configuration, *(other.configuration for other in declared.elsewhere)):
        ends = [end for end in ends_named(one, question.kind, question.name) if end.role is MAKERS[question.kind]]
        if ends:
            return [end.node for end in ends if not end.conditions] or [ends[0].node]
    return []


def _exists(question: Question, ends: Sequence[Endpoint], observed: Observed, apart: Step | None) -> Step:
    if ends:
        counts = [(role, sum(one.role is role for one in ends)) for role in Role]
        said = ", ".join(
            f"{count} {role.value.replace('_', ' ')}{'s' * (count > 1)}" for role, count in counts if count
        )
        return Step(Asks.EXISTS, StepState.OK, f"{said} of it {'is' if len(ends) == 1 else 'are'} there", "live")
    if apart is not None and apart.state is StepState.NOT:
        says = f"nobody that is seen uses {question.name}: {apart.says}"
        return Step(Asks.EXISTS, StepState.NOT, says, "live", apart.evidence, apart.how, apart.command)
    near = near_names(question.name, {one.name for one in observed.graph.endpoints})
    how = f"nearest names that are there: {', '.join(near)}" if near else "look at what runs"
    return Step(Asks.EXISTS, StepState.NOT, f"nobody that runs uses {question.name}", "live", how=how,
                command="roslens watch --for 10s")  # fmt: skip


def _makers(question: Question, makers: Sequence[Endpoint], observed: Observed, reasons: Sequence[Step]) -> Step:
    """Return who makes it; where nobody does, with the first of the steps that may be the reason."""
    if makers:
        nodes = {one.name: one for one in observed.graph.nodes}
        lines = tuple(_place(one.node, nodes.get(one.node)) for one in makers[:_MOST])
        return Step(Asks.MADE, StepState.OK, _who_does(makers), "live", lines)
    verb = VERB[MAKERS[question.kind]]
    role = MAKERS[question.kind]
    near = near_names(question.name, {one.name for one in observed.graph.endpoints if one.role is role})
    reason = next((one for one in reasons if one.state is StepState.NOT), None)
    reason = reason or next(
        (one for one in reasons if one.asks is Asks.REACHED and one.state is not StepState.OK), None
    )
    if reason is not None:
        says = f"no node that is seen {verb} it: {reason.says}"
        return Step(Asks.MADE, StepState.NOT, says, "live", reason.evidence, reason.how, reason.command)
    how = f"start what {verb} it"
    how += f"; names alike that somebody {verb}: {', '.join(near)}" if near else ""
    return Step(Asks.MADE, StepState.NOT, f"no node that runs {verb} it", "live", how=how)


def _who_does(ends: Sequence[Endpoint]) -> str:
    names = list(dict.fromkeys(one.node for one in ends))[:_MOST]
    return f"{', '.join(names)} {verb_of(ends[0].role, len(names))} it"


def _place(name: str, node: Node | None) -> str:
    if node is None or not node.pid:
        return f"{name}: its process is not known"
    return f"{name}: process {node.pid}{f' on {node.host}' if node.host else ''}"


def _runs(
    makers: Sequence[str], wanted: Sequence[ConfiguredNode], observed: Observed
) -> tuple[list[Step], list[ConfiguredNode]]:
    """Return whether the makers run and are active, and which nodes of source do not run."""
    nodes = {one.name: one for one in observed.graph.nodes}
    steps = []
    missing = [one for one in wanted if one.name not in nodes]
    for one in missing[:_MOST]:
        ended = next((other for other in observed.ended if other.node == one.name), None)
        if ended is not None:
            says, lines = f"{one.name} ended: {ended.how or 'how is not known'}", ended.said
        else:
            says = f"{one.name}, which should make it, does not run or is not seen"
            lines = (f"{one.package}/{one.executable}, started at {one.proof.place}",)
        run = "ros2 run" if observed.graph.generation != "ros1" else "rosrun"
        steps.append(Step(Asks.RUNS, StepState.NOT, says, "live", lines, "start it, or look at its log",
                          f"{run} {one.package} {one.executable}" if one.package else ""))  # fmt: skip
    there = [nodes[name] for name in dict.fromkeys((*makers, *(one.name for one in wanted))) if name in nodes]
    for node in there:
        steps += _state_of(node)
    if (clock := clock_missing({one.name for one in there}, observed)) is not None:
        steps.append(clock)
    if there and not any(one.state is StepState.NOT for one in steps):
        names = ", ".join(one.name for one in there[:_MOST])
        steps.append(Step(Asks.RUNS, StepState.OK, f"{names} run{'s' * (len(there) == 1)}", "live"))
    return steps, missing


def _state_of(node: Node) -> Iterator[Step]:
    state = node.lifecycle.lower()
    if state in _NOT_ACTIVE:
        verb = {"unconfigured": "configure", "inactive": "activate"}.get(state, "")
        yield Step(
            Asks.RUNS, StepState.NOT, f"{node.name} is {state}: {_NOT_ACTIVE[state]}", "live",
            command=f"ros2 lifecycle set {node.name} {verb}" if verb else f"ros2 lifecycle get {node.name}",
        )  # fmt: skip
    if node.instances:
        places = tuple(f"process {one.pid} on {one.host}" for one in node.instances)
        yield Step(Asks.RUNS, StepState.NOT, f"{len(node.instances)} nodes are called {node.name}", "live", places,
                   "give each its own name or namespace")  # fmt: skip


def _traffic(question: Question, observed: Observed, *, has_makers: bool) -> Iterator[Step]:
    values = observed.values.get(question.entity, {})
    rate, received = values.get("rate"), values.get("rate_received")
    during = f"in {observed.seconds:.1f} s" if observed.seconds else "lately"
    if rate is None:
        if has_makers:
            yield Step(Asks.SENT, StepState.UNSEEN, f"what is sent was not counted {during}", "live",
                       how="subscribe to it within a budget, for a longer time",
                       command=f"roslens why {question.name} --live --for 10s --tap {question.name}")  # fmt: skip
    elif rate > 0:
        yield Step(Asks.SENT, StepState.OK, f"{rate:.3g} Hz", "live")
    elif has_makers:
        yield Step(Asks.SENT, StepState.NOT, f"no message came {during}, though somebody publishes it", "live",
                   how="it comes on an event, its publisher is stuck, or it does not reach this host")  # fmt: skip
    if rate and received is not None:
        state = StepState.OK if received > 0 else StepState.NOT
        yield Step(Asks.RECEIVED, state, f"the subscriber that gets fewest gets {received:.3g} Hz", "live")
    if rate and (loss := values.get("loss")):
        yield Step(
            Asks.RECEIVED,
            StepState.NOT,
            f"{loss:.1f} % of the messages did not arrive",
            "live",
            how="look at the network between the hosts, the depth of the queues, and the subscriber's processor",
        )


def _of_node(question: Question, observed: Observed, declared: Declared | None) -> Iterator[Step]:
    node = next((one for one in observed.graph.nodes if one.name == question.name), None)
    if node is not None:
        yield Step(Asks.EXISTS, StepState.OK, "it is there", "live", (_place(node.name, node),))
    wanted = [] if declared is None else [
        one for one in declared.configuration.nodes if one.name == question.name and one.resolved
    ]  # fmt: skip
    if node is None and not wanted:
        near = near_names(question.name, {one.name for one in observed.graph.nodes})
        how = f"nearest names that are there: {', '.join(near)}" if near else ""
        yield Step(Asks.EXISTS, StepState.NOT, "no node of this name runs", "live", how=how)
    runs, missing = _runs([question.name] if node is not None else [], wanted, observed)
    yield from runs
    apart = reached(observed, _programs(missing), f"node:{question.name}")
    if apart is not None:
        yield apart
