"""All units of a workspace: what is started, what is loaded by name, and classes that make endpoints in neither."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from roslens.source.extract.facts.node_facts import NodeFacts
from roslens.source.extract.ir.program import Function
from roslens.source.extract.symbols.call_sites import functions_with_more
from roslens.source.extract.symbols.node_bases import generation_of
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.units.node_units import (
    facts_of_class,
    facts_of_function,
    facts_of_main,
    facts_of_module,
    facts_of_plugin,
    node_classes,
    registered,
)
from roslens.source.extract.units.tree_nodes import facts_of_registration

_REGISTRY = "BT_REGISTER_NODES"
_TESTS = ("TEST", "SCENARIO", "TEMPLATE_TEST")


def facts_of_workspace(
    index: SymbolTable, reached: Reached | None = None, entries: Iterable[tuple[str, str]] = ()
) -> list[NodeFacts]:
    """Return the facts of all units of a workspace, in order of their files.

    Classes that are nodes, plug-ins that are registered, nodes of behaviour trees, programs and scripts come first.
    Then classes that make endpoints and are reached by none of these, and functions: somebody outside makes, loads or
    calls them.

    Args:
        index: of the workspace.
        reached: is filled with the functions that were followed.
        entries: functions of Python modules that are started, by file and name.
    """
    reached = Reached() if reached is None else reached
    found: list[NodeFacts] = []
    known: set[str] = set()
    for defined, generation, kind in node_classes(index):
        known.add(defined.what.qualified_name)
        found += facts_of_class(index, defined, generation, kind, reached)
    for name, evidence in registered(index).items():
        plugin = index.class_of(name, evidence.path, "")
        if plugin is not None and plugin.what.qualified_name not in known:
            known.add(plugin.what.qualified_name)
            found += facts_of_plugin(index, plugin, generation_of(index, plugin.path), reached)
    for path in sorted(index.programs):
        found += _facts_of_file(index, path, reached)
    for defined in unreached(index, reached):
        found += facts_of_plugin(index, defined, generation_of(index, defined.path), reached)
    for path, name in sorted(entries):
        found += facts_of_module(index, path, name, reached)
    for path, function in never_called(index, reached):
        found += facts_of_function(index, path, function, reached)
    found += not_come_to(index, found, reached)
    return sorted(found, key=lambda one: (one.path, one.line, one.unit))


def _facts_of_file(index: SymbolTable, path: str, reached: Reached) -> Iterator[NodeFacts]:
    program = index.programs[path]
    if program.language == "python":
        yield from facts_of_module(index, path, reached=reached)
        return
    for function in program.functions:
        if function.qualified_name == "main":
            yield from facts_of_main(index, path, reached)
        elif function.name.startswith(_REGISTRY):
            yield from facts_of_registration(index, path, function, reached)


def unreached(index: SymbolTable, reached: Reached) -> Iterator[Defined]:
    """Yield the classes with a method that makes endpoints and was not evaluated: those that are no base first.

    ``reached`` may grow meanwhile; a class whose methods were evaluated as a base of another one is left out then.
    """
    classes = [Defined(path, one) for path in sorted(index.programs) for one in index.programs[path].classes]
    bases = {index.key(base) for one in classes for base in index.chain(one)[1:]}
    known: dict[int, bool] = {}
    for base in (False, True):
        for one in classes:
            if (index.key(one) in bases) is base and _makes(index, one, reached, known):
                yield one


def _makes(index: SymbolTable, defined: Defined, reached: Reached, known: dict[int, bool]) -> bool:
    """Whether a method that was not evaluated makes an endpoint; ``known`` caches it by identity."""
    for one in index.chain(defined):
        for method in index.methods_of(one):
            what = method.what
            if (method.path, what.line) in reached:
                continue
            makes = known.get(id(what))
            if makes is None:
                makes = known[id(what)] = bool(index.memo.calls_that_make(what))
            if makes:
                return True
    return False


def never_called(index: SymbolTable, reached: Reached) -> Iterator[tuple[str, Function]]:
    """Yield the functions that make endpoints and that nothing was seen to call: callbacks, parts of other programs.

    ``reached`` may grow meanwhile; functions around others come first, as they may call them.
    """
    for path in sorted(index.programs):
        for one in sorted(index.programs[path].functions, key=lambda one: (one.name == "lambda", one.line)):
            if not one.name.startswith("TEST") and (path, one.line) not in reached and index.memo.calls_that_make(one):
                yield path, one


def not_come_to(index: SymbolTable, found: Sequence[NodeFacts], reached: Reached) -> Iterator[NodeFacts]:
    """Yield what functions make on ways that no unit took, by evaluating them alone: only what is missing of endpoints.

    What is known of the members of their object kept evaluation from these ways, so it is forgotten.
    """
    for path, function, lines in list(functions_with_more(index, found, reached)):
        for one in facts_of_function(index, path, function, reached, prepared=False):
            ends = tuple(end for end in one.endpoints if end.evidence.path == path and end.evidence.line in lines)
            if ends:
                yield NodeFacts(one.unit, one.path, one.line, one.generation, "part", endpoints=ends)
