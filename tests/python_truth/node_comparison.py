"""Holds what evaluation says of a made-up node against what runs of it made."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from python_truth.node_stubs import Made, Run
from roslens.source.extract.facts.node_facts import EndpointFact, NodeFacts, ParameterFact, Sure
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.units.workspace_units import facts_of_workspace

Fact = EndpointFact | ParameterFact


class Disagreement(msgspec.Struct, frozen=True):
    """What is wrong: ``missed``, ``not always`` made, ``never`` made, or another ``quality``; the line and the name."""

    kind: str
    line: int
    name: str
    why: str = ""


def facts_of(program: str) -> NodeFacts | None:
    """Return what evaluation says of a program, started as a script."""
    found = facts_of_workspace(indexed({"pkg/made_up.py": program_of_python(program.encode())}))
    return next((one for one in found if one.unit == "<module>" and one.number == 0), None)


def may_be(text: Text, name: str) -> bool:
    """Whether a text may come to a name: what is unknown is anything, or one of the texts it is chosen from."""
    if not text.parts:
        return not name
    first, rest = text.parts[0], Text(text.parts[1:])
    if isinstance(first, str):
        return name.startswith(first) and may_be(rest, name[len(first) :])
    if first.choice and not text.parts[1:]:
        choice = first.choice[0]
        return may_be(choice.then, name) or may_be(choice.otherwise, name)
    return any(may_be(rest, name[place:]) for place in range(len(name) + 1))


def disagreements(program: str, runs: Sequence[Run]) -> list[Disagreement]:
    """Return in what evaluation and runs of a program disagree, in order of lines."""
    facts = facts_of(program)
    if facts is None:
        return [Disagreement("missed", 0, "", "no node at all")]
    found = {*_missed(facts, runs), *_not_always(facts, runs), *_other_quality(facts, runs)}
    return sorted(found, key=lambda one: (one.line, one.kind, one.name))


def _line(fact: Fact) -> int:
    """Return the line at which something is made: a fact speaks of the call of the function that makes it.

    Of a parameter that a function declares no more is reported than that call: it is 0.
    """
    if isinstance(fact, ParameterFact):
        return 0
    return fact.through[-1].line if fact.through else fact.evidence.line


def _all(facts: NodeFacts) -> list[tuple[str, Fact]]:
    ends: list[tuple[str, Fact]] = [(str(one.role.value), one) for one in facts.endpoints]
    return [*ends, *(("parameter", one) for one in facts.parameters)]


def _missed(facts: NodeFacts, runs: Sequence[Run]) -> list[Disagreement]:
    reported = {evidence.line for evidence, _ in facts.unresolved}
    known: dict[tuple[int, str], list[Text]] = {}
    for role, one in _all(facts):
        known.setdefault((_line(one), role), []).append(one.name)
    wrong = []
    for made in {made for run in runs for made in run.made}:
        names = known.get((made.line * (made.role != "parameter"), made.role), [])
        if made.line not in reported and not any(may_be(text, made.name) for text in names):
            wrong.append(Disagreement("missed", made.line, made.name, f"known are {sorted(map(str, names))}"))
    return wrong


def _sure(facts: NodeFacts) -> list[tuple[str, str, Fact]]:
    """Return role, name and fact of what is said to be made in any case."""
    if facts.conditions:
        return []
    return [
        (role, one.name.known, one)
        for role, one in _all(facts)
        if one.name.known is not None and one.evidence.sure is Sure.CERTAIN and not one.conditions
    ]


def _not_always(facts: NodeFacts, runs: Sequence[Run]) -> list[Disagreement]:
    normal = [run for run in runs if not run.error and not run.left]
    wrong = []
    for role, name, one in _sure(facts):
        line = _line(one)
        made = [any((it.role, it.name) == (role, name) and line in (0, it.line) for it in run.made) for run in normal]
        if not all(made):
            kind = "not always" if any(made) else "never"
            wrong.append(Disagreement(kind, one.evidence.line, name, f"{sum(made)} of {len(made)} runs"))
    return wrong


def _other_quality(facts: NodeFacts, runs: Sequence[Run]) -> list[Disagreement]:
    """A quality of service that is said to be known is that of each endpoint that one fact alone speaks of."""
    wrong = []
    for one in facts.endpoints:
        if one.evidence.sure is not Sure.CERTAIN or one.qos is None or one.name.known is None:
            continue
        same = [it for it in facts.endpoints if _line(it) == _line(one) and may_be(it.name, one.name.known)]
        said = [_quality(it) for it in same]
        if None in said:
            continue
        for made in {made for run in runs for made in run.made if made.line == _line(one)}:
            if made.name == one.name.known and _of_run(made) not in said:
                wrong.append(Disagreement("quality", made.line, made.name, f"{_of_run(made)}, known are {said}"))
    return wrong


def _quality(fact: EndpointFact) -> tuple[int, str, str] | None:
    qos = fact.qos
    if qos is None or fact.qos_unknown or not (qos.reliability and qos.durability):
        return None
    return qos.depth, qos.reliability, qos.durability


def _of_run(made: Made) -> tuple[int, str, str]:
    return made.depth, made.reliability, made.durability
