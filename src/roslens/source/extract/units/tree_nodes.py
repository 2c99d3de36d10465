"""Nodes of behaviour trees: the classes that a function registers as such."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Obj, Unknown, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.facts.node_facts import NodeFacts
from roslens.source.extract.interpreter.interpreter import Interpreter
from roslens.source.extract.ir.program import Assign, Call, Evaluate, Function, Member
from roslens.source.extract.symbols.noted_table import NotedTable
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable, type_name
from roslens.source.extract.units.finished_unit import building_of, finished
from roslens.source.extract.units.node_units import TREE_REGISTRATIONS, run_methods


def facts_of_registration(
    index: SymbolTable, path: str, function: Function, reached: Reached | None = None
) -> list[NodeFacts]:
    """Return the facts of the classes that a function registers as nodes of behaviour trees."""
    found: list[NodeFacts] = []
    for statement in function.body:
        match statement:
            case Evaluate(expression=Call(function=Member(name=name), templates=(kind, *_)) as call) if (
                name in TREE_REGISTRATIONS
            ):
                defined = index.class_of(type_name(kind)[0], path, function.qualified_name)
                if defined is not None:
                    found += _facts_of_tree_node(index, defined, (path, function, call), reached)
    return found


def _facts_of_tree_node(
    index: SymbolTable, defined: Defined, registered_by: tuple[str, Function, Call], reached: Reached | None
) -> list[NodeFacts]:
    path, function, call = registered_by
    building = building_of(defined.what.qualified_name, defined.path, defined.what.line, "ros2", "plugin")
    building.named = True
    ctx = Interpreter(NotedTable(index, defined.path, path), building)
    unknown: list[Value] = [Unknown("name in the behaviour tree"), Unknown("configuration of the behaviour tree")]

    def run() -> None:
        ctx.state.frame = Frame(path, function.qualified_name)
        ctx.block(tuple(one for one in function.body if isinstance(one, Assign)))
        builder = ctx.value(call.arguments[1]) if len(call.arguments) > 1 else None
        match builder:
            case Callable():
                thing = ctx.call(Invocation(builder, unknown))
            case _:
                thing = ctx.objects.construct(defined, unknown, {})
        match thing:
            case Obj():
                run_methods(ctx, thing)

    name = ("tree", path, function.qualified_name, str(function.line), str(call.line), index.key(defined), defined.path)
    return finished(ctx, run, reached, name)
