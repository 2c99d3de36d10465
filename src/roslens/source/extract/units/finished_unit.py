"""What the evaluation of a unit leaves: its facts, those of a known unit as they were, the doubts of a cut one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import msgspec

from roslens.source.extract.domain.abstract_value import NodeBuilder
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts, Sure
from roslens.source.extract.interpreter.interpreter import Interpreter
from roslens.source.extract.ir.program import Function
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.symbols.evaluated_unit import EvaluatedUnit, UnitName
from roslens.source.extract.symbols.noted_table import NotedTable
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.transfer.budget import BudgetExceededError
from roslens.source.keys import key_of

_ODD = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What values that fit nowhere may raise: source that does not compile must not hide what is found elsewhere."""


def finished(ctx: Interpreter, run: Callable[[], None], reached: Reached | None, name: UnitName) -> list[NodeFacts]:
    """Return what ``run`` makes; of a unit that is known under its name, what it made the first time."""
    units, table = ctx.index.units, ctx.index
    unit = None if units is None else units.get(name)
    if unit is None:
        facts = tuple(_made(ctx, run))
        unit = EvaluatedUnit(facts, ctx.callbacks.reached, table.files if isinstance(table, NotedTable) else ())
        if units is not None:
            units.add(name, unit)
    if reached is not None:
        reached.add_all(unit.reached)
    return list(unit.facts)


def class_name(kind: str, index: SymbolTable, defined: Defined) -> UnitName:
    """Return what of the name of a unit tells which class it is of."""
    return kind, index.key(defined), defined.path, str(defined.what.line)


def function_place(index: SymbolTable, path: str, function: Function) -> str:
    """Return which function of a file is meant: several of one line are alike but for their place."""
    places = (place for place, one in enumerate(index.programs[path].functions) if one is function)
    return f"{function.line}:{next(places, '')}"


def given_names(chosen: Chosen | None, plugin_names: Mapping[str, str]) -> UnitName:
    """Return what of the name of a unit tells which plug-ins are loaded."""
    if chosen is None:
        return ()
    return "plug-ins", key_of(chosen, dict(plugin_names))


def given_words(words: Sequence[Text] | None) -> UnitName:
    """Return what of the name of a unit tells with which words it is started."""
    return () if words is None else ("words", key_of(tuple(words)))


def _made(ctx: Interpreter, run: Callable[[], None]) -> list[NodeFacts]:
    try:
        run()
    except (BudgetExceededError, RecursionError):
        node = ctx.emitter.node
        place = Evidence(node.path, node.line)
        node.unresolved.append((place, "evaluation exceeded its limit of steps; partial results are kept"))
        for one in (node, *ctx.emitter.others):
            _doubt_conditions(one)
    except _ODD as error:
        site = ctx.state.site
        reason = f"internal error while evaluating {site.path}:{site.line} ({error})"
        ctx.emitter.node.unresolved.append((site, f"{reason}; partial results are kept"))
    return [one.facts() for one in (ctx.emitter.node, *ctx.emitter.others)]


def _doubt_conditions(node: NodeBuilder) -> None:
    """Doubt what is made under conditions: what was not followed may make it under others."""
    facts: Any
    for facts in (node.endpoints, node.parameters):
        for place, fact in enumerate(facts):
            if fact.conditions and fact.evidence.sure is Sure.CERTAIN:
                evidence = msgspec.structs.replace(fact.evidence, sure=Sure.LIKELY, how="one of several paths to it")
                facts[place] = msgspec.structs.replace(fact, evidence=evidence)


def building_of(unit: str, path: str, line: int, generation: str, kind: str) -> NodeBuilder:
    """Return a node of which nothing was collected yet."""
    building = NodeBuilder(unit, path, line, generation, kind)
    building.endpoints, building.parameters, building.timers = [], [], []
    building.arguments, building.settings = [], []
    building.uses, building.unresolved = [], []
    building.plugins, building.asks = [], []
    return building
