"""Calls that are named as what makes an endpoint, and of which nothing came: each is reported, with its reason.

No call of a program that the vocabulary knows by name is lost: an endpoint is made there, or a function of the
workspace answers it, or it is reported here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from roslens.model.configuration import Missing
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts
from roslens.source.extract.ir.makes_endpoints import calls_that_make
from roslens.source.extract.ir.program import Call, Function, Member, Name
from roslens.source.extract.ir.program_text import expression_text
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import SymbolTable

NEVER_FOLLOWED = "this call seems to create an endpoint, but no evaluated code reaches it"
NOT_KNOWN = "this call seems to create an endpoint, but evaluating the code around it yielded none"
_TIMERS = frozenset({"create_wall_timer"})
NAMED_ALIKE = "this calls a function of the workspace that is named like one that creates endpoints, and creates none"
_LONGEST = 160


def without_endpoint(index: SymbolTable, facts: Iterable[NodeFacts], reached: Reached) -> Iterator[Unresolved]:
    """Yield the calls of which no unit made an endpoint, in order of their files.

    Args:
        index: of the workspace.
        facts: of all its units.
        reached: what evaluating them reached.
    """
    for path, function, call in _left(index, facts, reached):
        known = function is None or (path, function.line) in reached
        reason = NOT_KNOWN if known else NEVER_FOLLOWED
        place = Evidence(path, call.line, call.column)
        if (path, call.line) in reached.passed_on:
            yield Unresolved(_shown(call), place, NAMED_ALIKE, missing=Missing.NAMED_ALIKE)
        else:
            yield Unresolved(_shown(call), place, reason)


def functions_with_more(
    index: SymbolTable, facts: Iterable[NodeFacts], reached: Reached
) -> Iterator[tuple[str, Function, set[int]]]:
    """Yield functions that were followed and the lines of calls in them that nothing came to: on ways not taken."""
    found: dict[tuple[str, int], tuple[Function, set[int]]] = {}
    for path, function, call in _left(index, facts, reached):
        if function is not None and (path, call.line) not in reached.passed_on:
            found.setdefault((path, function.line), (function, set()))[1].add(call.line)
    for (path, _), (function, lines) in found.items():
        yield path, function, lines


def _left(
    index: SymbolTable, facts: Iterable[NodeFacts], reached: Reached
) -> Iterator[tuple[str, Function | None, Call]]:
    made = {place for one in facts for place in places_of(one)} | {
        site for site, makes in reached.passed_on.items() if makes
    }
    for path in sorted(index.programs):
        program = index.programs[path]
        parts: list[tuple[Function | None, Iterable[Call]]] = [(None, calls_that_make(program.body))]
        parts += [
            (one, index.memo.calls_that_make(one)) for one in program.functions if not one.name.startswith("TEST")
        ]
        reported: set[int] = set()
        for function, calls in parts:
            for call in calls:
                if (path, call.line) not in made and call.line not in reported and not _is_timer(call):
                    reported.add(call.line)
                    yield path, function, call


def places_of(facts: NodeFacts) -> Iterator[tuple[str, int]]:
    """Yield where the endpoints of a unit are made: their calls, and those of helpers that pass names on."""
    for one in facts.endpoints:
        for place in (one.evidence, *one.through):
            yield place.path, place.line


def _is_timer(call: Call) -> bool:
    match call.function:
        case Name(name=name) | Member(name=name):
            return name.rpartition(".")[2] in _TIMERS
    return False


def _shown(call: Call) -> str:
    text = expression_text(call)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 1] + "…"
