"""An answer out of what source, a recording and a running system say of one entity."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.compare.why.declared import MAKERS, Declared, known_names
from roslens.compare.why.from_live import steps_of_live
from roslens.compare.why.from_recording import steps_of_recording
from roslens.compare.why.from_source import steps_of_source
from roslens.compare.why.observed import Observed
from roslens.compare.why.question import Known, Question
from roslens.compare.why.recorded import Recorded
from roslens.model.answers.answer import Answer, Asks, Step, StepState, in_order
from roslens.model.errors import UsageError
from roslens.model.graphs.end import KIND


def known_to(declared: Declared | None, recorded: Recorded | None, observed: Observed | None = None) -> Known:
    """Return all names that can be asked about, by kind."""
    found: dict[str, set[str]] = known_names(declared) if declared is not None else {}
    if recorded is not None:
        found.setdefault("topic", set()).update(recorded.topics)
        found.setdefault("node", set()).update(one.name for one in recorded.graph.nodes)
    if observed is not None:
        for one in observed.graph.endpoints:
            found.setdefault(KIND[one.role], set()).add(one.name)
        found.setdefault("node", set()).update(one.name for one in observed.graph.nodes)
    return found


def answer(
    question: Question, declared: Declared | None, recorded: Recorded | None, observed: Observed | None = None
) -> Answer:
    """Return the steps about an entity, in order; what none of them can see is said last of each question.

    Raises:
        UsageError: nothing that was looked at tells of entities of this kind.
    """
    steps: list[Step] = []
    if observed is not None:
        steps += steps_of_live(question, observed, declared)
    if recorded is not None:
        steps += steps_of_recording(question, recorded, declared)
    if declared is not None:
        steps += steps_of_source(question, declared)
    steps = list(_of_what_is_there(steps))
    if not steps:
        raise UsageError(
            f'nothing that was looked at tells of {question.kind} "{question.name}"',
            expected="a topic, node, service or action; of frames a recording, or ROS 2 that runs",
        )
    steps += _unseen(question, {one.asks for one in steps}, live=observed is not None)
    looked_at = [f"live: {observed.title}"] if observed is not None else []
    looked_at += [f"source: {declared.title}"] if declared is not None else []
    looked_at += [f"recording: {recorded.title}"] if recorded is not None else []
    notes = tuple(observed.failures) if observed is not None else ()
    notes += recorded.failures if recorded is not None else ()
    notes += declared.failures if declared is not None else ()
    return Answer(question.entity, tuple(looked_at), in_order(tuple(steps)), notes)


def _of_what_is_there(steps: Sequence[Step]) -> Iterator[Step]:
    """Yield steps; that source does not have what was seen is no cause: it may be of another workspace."""
    seen = {one.asks for one in steps if one.of in ("live", "recording") and one.state is StepState.OK}
    for one in steps:
        is_refuted = one.of == "source" and one.asks in (Asks.EXISTS, Asks.MADE) and one.asks in seen
        yield msgspec.structs.replace(one, state=StepState.UNSEEN) if is_refuted and one.state is StepState.NOT else one


def _unseen(question: Question, told: set[Asks], *, live: bool) -> Iterator[Step]:
    """Yield the questions that only a running system answers, and that nothing here did."""
    if question.kind not in (*MAKERS, "node"):
        return
    only_live = [
        (Asks.RUNS, "whether its nodes run, crashed or are inactive"),
        (Asks.REACHED, "whether domain, discovery range and middleware are the same on both sides"),
    ]
    if question.kind == "topic":
        only_live += [(Asks.SENT, "whether messages are sent, and how often"),
                      (Asks.RECEIVED, "whether what is sent arrives, and when")]  # fmt: skip
    how = (
        "start its nodes through `roslens run`, which counts what they send and receive"
        if live
        else "look while it runs"
    )
    command = "" if live else f"roslens why {question.name} --live"
    for asks, what in only_live:
        if asks not in told:
            yield Step(asks, StepState.UNSEEN, f"{what} is not in what was looked at", "", how=how, command=command)
