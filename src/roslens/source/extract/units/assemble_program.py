"""Programs that make nodes of classes: the facts of their main function and of the classes, merged.

A main function gives names and arguments; what a node does after it was made (its life cycle, its callbacks) is in
its class.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts
from roslens.source.extract.ir.program import Call, Function
from roslens.source.extract.symbolic.reason import is_of_many
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable


def classes_made(index: SymbolTable, path: str, nodes: Sequence[Defined]) -> Iterator[str]:
    """Yield the keys of the classes of nodes that the main function of a file makes, in order, each once.

    Args:
        index: of the workspace.
        path: of the file.
        nodes: the classes that are nodes.
    """
    keys = {index.key(one) for one in nodes}
    seen: set[str] = set()
    for function in index.programs[path].functions:
        if function.qualified_name != "main":
            continue
        for name in _written(function):
            found = index.class_of(name.replace("::", "."), path, "")
            key = "" if found is None else index.key(found)
            if key in keys and key not in seen:
                seen.add(key)
                yield key


def _written(function: Function) -> Iterator[str]:
    """Yield template arguments of calls, as of ``make_shared<Node>``, in order."""
    waiting: list[object] = [function.body]
    while waiting:
        one = waiting.pop(0)
        match one:
            case tuple():
                waiting[:0] = one
            case Call():
                yield from one.templates
                waiting[:0] = msgspec.structs.astuple(one)
            case msgspec.Struct():
                waiting[:0] = msgspec.structs.astuple(one)


def joined_facts(main: NodeFacts | None, of_class: NodeFacts) -> NodeFacts:
    """Return the merged facts of the main function of a program and of the class of the node that it creates.

    Args:
        main: facts of the main function; None where it tells nothing.
        of_class: facts of the class.
    """
    if main is None:
        return of_class
    name = main.name if main.name.usual else of_class.name
    return msgspec.structs.replace(
        of_class,
        name=name if name.parts else main.name,
        namespace=main.namespace if main.namespace.parts else of_class.namespace,
        endpoints=_both(main.endpoints, of_class.endpoints),
        parameters=tuple(dict.fromkeys((*main.parameters, *of_class.parameters))),
        timers=tuple(dict.fromkeys((*main.timers, *of_class.timers))),
        arguments=main.arguments or of_class.arguments,
        conditions=main.conditions,
        settings=tuple(dict.fromkeys((*main.settings, *of_class.settings))),
        global_arguments=main.global_arguments and of_class.global_arguments,
        unresolved=tuple(dict.fromkeys((*main.unresolved, *of_class.unresolved))),
        declares_set=main.declares_set or of_class.declares_set,
        doubt=main.doubt or of_class.doubt,
        loads=tuple(dict.fromkeys((*main.loads, *of_class.loads))),
        asks=tuple(dict.fromkeys((*main.asks, *of_class.asks))),
        plugins=tuple(dict.fromkeys((*main.plugins, *of_class.plugins))),
    )


def _both(first: Sequence[EndpointFact], second: Sequence[EndpointFact]) -> tuple[EndpointFact, ...]:
    """Return the endpoints of both; of one in both, that of main, unless its name is unknown there."""
    better = {_place(one.evidence) for one in second if not _vague(one)}
    kept = [one for one in first if not _vague(one) or _place(one.evidence) not in better]
    reported = {_place(one.evidence) for one in kept}
    return (*kept, *(one for one in second if _place(one.evidence) not in reported))


def _vague(fact: EndpointFact) -> bool:
    # One of many texts is a choice too, of which more is known than of what was not evaluated.
    unknown = (hole for hole in fact.name.holes if not hole.choice and not is_of_many(hole.reason))
    return any(hole.default is None and not hole.parameter for hole in unknown)


def _place(evidence: Evidence) -> tuple[str, int, int]:
    return evidence.path, evidence.line, evidence.column
