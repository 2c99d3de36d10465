"""Which of our entities the classes and functions of a cccc report are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.model.entity import Entity, EntityKind
from roslens.source.tools.cccc_quantities import CYCLOMATIC_COMPLEXITY
from roslens.source.tools.cccc_report import CcccFunction, CcccModule
from roslens.source.tools.paper2016 import StudiedFile, class_values

_NEAR = 2
"""Lines between what cccc and we call the first line of a function."""


def matched_values(entities: Sequence[Entity], files: Iterable[StudiedFile]) -> dict[str, dict[str, float]]:
    """Return the results of cccc for our classes and functions: values by key, by the id of the entity.

    A class that is not defined in the file that names it is the one class of that name in the package, if there is
    one only. What is seen several times has the largest value. Modules that are no class of ours (namespaces, types
    from elsewhere) are left out.
    """
    here, anywhere = _by_name(entities)
    found: dict[str, dict[str, float]] = {}
    for file in files:
        for module in file.report.modules:
            if entity := _class_of(module, here.get((file.path, module.name), ()), anywhere.get(module.name, ())):
                _raise(found.setdefault(entity.id, {}), class_values(module))
        for function in file.report.functions:
            if function.complexity >= 1 and (entity := _function_of(function, here, file.path)):
                values = {CYCLOMATIC_COMPLEXITY.key: float(function.complexity)}
                _raise(found.setdefault(entity.id, {}), values)
    return {entity: values for entity, values in found.items() if values}


def _by_name(entities: Iterable[Entity]) -> tuple[dict[tuple[str, str], list[Entity]], dict[str, list[Entity]]]:
    here: dict[tuple[str, str], list[Entity]] = {}
    anywhere: dict[str, list[Entity]] = {}
    for entity in entities:
        name = entity.name.rpartition("::")[2]
        if entity.kind is EntityKind.CLASS:
            here.setdefault((entity.path, name), []).append(entity)
            anywhere.setdefault(name, []).append(entity)
        elif entity.kind is EntityKind.FUNCTION:
            here.setdefault((entity.path, f"{name}("), []).append(entity)
    return here, anywhere


def _class_of(module: CcccModule, here: Sequence[Entity], anywhere: Sequence[Entity]) -> Entity | None:
    if here:
        return min(here, key=lambda entity: (abs(entity.line - module.line), entity.line, entity.id))
    return anywhere[0] if len(anywhere) == 1 else None


def _function_of(function: CcccFunction, here: dict[tuple[str, str], list[Entity]], path: str) -> Entity | None:
    name = function.name.partition("(")[0].strip()
    near = [
        entity
        for entity in here.get((path, f"{name}("), ())
        if entity.line - _NEAR <= function.line <= max(entity.line, entity.end_line)
    ]
    return min(near, key=lambda entity: (abs(entity.line - function.line), entity.id), default=None)


def _raise(values: dict[str, float], more: dict[str, float]) -> None:
    for key, value in more.items():
        values[key] = max(value, values.get(key, value))
