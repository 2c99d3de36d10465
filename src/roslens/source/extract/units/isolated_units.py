"""All units of a workspace, where one that breaks its evaluation does not lose the others."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import NodeFacts, Target
from roslens.source.extract.symbols.call_sites import without_endpoint
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
from roslens.source.extract.units.workspace_units import facts_of_workspace, never_called, unreached

Unit = Callable[[], Iterable[NodeFacts]]
_SELDOM = 50_000
"""Objects that are made, less those that are gone, between two collections: some ten megabytes."""


class Units(NamedTuple):
    """What all units make: their facts, calls that look as if they made endpoints and do not, and what broke."""

    facts: tuple[NodeFacts, ...]
    without_endpoint: tuple[Unresolved, ...]
    failures: tuple[Failure, ...]


def units_of(index: SymbolTable, targets: Iterable[Target]) -> Units:
    """Return the facts of all units in order of their files, each once, and what is missing in them.

    Args:
        index: of the workspace.
        targets: of all packages: they name the functions of Python modules that are started.
    """
    failures: list[Failure] = []
    found: list[NodeFacts] = []
    reached = Reached()
    entries = _entries(index, targets)
    with _spared():
        try:
            found += facts_of_workspace(index, reached, entries)
        except Exception:  # noqa: BLE001 - which unit it was is found by evaluating them one by one
            found += _one_by_one(index, failures, reached, entries)
    order = sorted(found, key=lambda one: (one.path, one.line, one.unit))
    facts = tuple(one for place, one in enumerate(order) if not place or one != order[place - 1])
    return Units(facts, tuple(without_endpoint(index, facts, reached)), tuple(failures))


@contextmanager
def _spared() -> Iterator[None]:
    """Spare the collector of garbage what is there already: programs, hundreds of thousands of objects that stay.

    What evaluation leaves in cycles is little, so it is collected seldom.
    """
    usual = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(_SELDOM, *usual[1:])
    try:
        yield
    finally:
        gc.set_threshold(*usual)
        gc.unfreeze()


def _entries(index: SymbolTable, targets: Iterable[Target]) -> set[tuple[str, str]]:
    """Return file and function of the entry points of Python packages."""
    found = set()
    for target in targets:
        module, _, function = target.entry.replace("::", ".").partition(":")
        if not function:
            continue
        ends = (module.replace(".", "/") + ".py", module.replace(".", "/") + "/__init__.py")
        paths = [path for path in target.sources if path.endswith(ends)] or list(target.sources)
        found |= {(path, function) for path in paths if path in index.programs}
    return found


def _one_by_one(
    index: SymbolTable, failures: list[Failure], reached: Reached, entries: set[tuple[str, str]]
) -> Iterator[NodeFacts]:
    reached.clear()
    reached.passed_on.clear()
    known: set[str] = set()

    def plugin(defined: Defined) -> Unit:
        return lambda: facts_of_plugin(index, defined, generation_of(index, defined.path), reached)

    for defined, generation, kind in list(node_classes(index)):
        known.add(defined.what.qualified_name)

        def of_class(one: Defined = defined, generation: str = generation, kind: str = kind) -> Iterable[NodeFacts]:
            return facts_of_class(index, one, generation, kind, reached)

        yield from attempt(of_class, defined.path, defined.what.line, failures)
    for name, evidence in registered(index).items():
        found = index.class_of(name, evidence.path, "")
        if found is not None and found.what.qualified_name not in known:
            known.add(found.what.qualified_name)
            yield from attempt(plugin(found), found.path, found.what.line, failures)
    for path in sorted(index.programs):
        start = facts_of_module if index.programs[path].language == "python" else facts_of_main

        def of_file(path: str = path, start: Callable[..., list[NodeFacts]] = start) -> Iterable[NodeFacts]:
            return start(index, path, reached=reached)

        yield from attempt(of_file, path, 0, failures)
    for defined in list(unreached(index, reached)):
        yield from attempt(plugin(defined), defined.path, defined.what.line, failures)
    for path, name in sorted(entries):
        yield from attempt(partial(facts_of_module, index, path, name, reached), path, 0, failures)
    for path, function in never_called(index, reached):
        unit = partial(facts_of_function, index, path, function, reached)
        yield from attempt(unit, path, function.line, failures)


def attempt(unit: Unit, path: str, line: int, failures: list[Failure]) -> list[NodeFacts]:
    """Return the facts of a unit; what breaks it is added to ``failures``."""
    try:
        return list(unit())
    except Exception as error:  # noqa: BLE001 - one unit must not lose the others
        import traceback

        failures.append(
            Failure(
                tool="graph",
                what=f"{type(error).__name__}: {error}",
                expected="code whose nodes and endpoints can be evaluated",
                advice="Please report it with the file: this is a bug in roslens",
                location=Location(path, line),
                entity=str(EntityId(EntityKind.FILE, path)),
                partial=True,
                detail="".join(traceback.format_exception(error)),
            )
        )
        return []
