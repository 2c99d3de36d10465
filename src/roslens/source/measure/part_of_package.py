"""A package of which only some files are looked at: what holds all the same, and what is left to a whole look."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.model.entity import Entity, EntityKind
from roslens.source.measure.package_task import PackageTask
from roslens.source.metrics.size import duplicated_lines
from roslens.source.metrics.table import metrics_with
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import REGISTERING_CPP, REGISTERING_PYTHON, STREAM, callbacks_of
from roslens.source.rules.cpp_flow.member_facts import MEMBER, member_facts
from roslens.source.rules.flow.python_reached import REACHED, reached_facts
from roslens.source.rules.hit import EITHER, Hit


def registered_elsewhere(
    task: PackageTask, hits: Mapping[str, Sequence[Hit]], callbacks: Iterable[str]
) -> frozenset[str]:
    """Return the callbacks that files that are left out register, as far as what was found depends on them.

    A file is parsed only where it names such a function and something that registers one, or such a member.

    Args:
        task: the package, with the paths that are left out.
        hits: in the files that were looked at.
        callbacks: that these register.
    """
    known = frozenset(callbacks)
    names = {hit.callback for found in hits.values() for hit in found if hit.callback} - known
    either = {one for name in names for one in name.split(EITHER)}
    functions = {_last(one.removeprefix(STREAM).removeprefix(REACHED)) for one in either if not one.startswith(MEMBER)}
    members = {_last(name.removeprefix(MEMBER).partition(" ")[0]) for name in names if name.startswith(MEMBER)}
    if not names:
        return known
    return known.union(*_registered(task, functions, members))


def _last(name: str) -> bytes:
    return name.replace("::", ".").rpartition(".")[2].encode()


def _registered(task: PackageTask, functions: set[bytes], members: set[bytes]) -> Iterator[tuple[str, ...]]:
    registering = {"cpp": REGISTERING_CPP, "python": REGISTERING_PYTHON}
    for file in task.files:
        if file.path not in task.left_out:
            continue
        with suppress(OSError, OverBudgetError):
            content = read_bounded(f"{task.root}/{file.path}")
            names = registering.get(file.language.parsed_as, frozenset())
            registers = any(name.encode() in content for name in names)
            if any(word in content for word in members) or (registers and any(word in content for word in functions)):
                with file_budget(file.path, size=len(content)):
                    view = parse_file(content, file.language, task.macros).view()
                    yield (*callbacks_of(view), *member_facts(view), *reached_facts(view))


def without_the_whole(entities: Sequence[Entity]) -> tuple[Entity, ...]:
    """Return entities without the values that need all files of the package: of the package, of classes, of copies."""
    of_classes = tuple(metric.QUANTITY.key for metric in metrics_with("of_class"))
    return tuple(_without(one, of_classes) for one in entities)


def _without(entity: Entity, of_classes: Sequence[str]) -> Entity:
    if entity.kind in (EntityKind.PACKAGE, EntityKind.CLASS):
        return msgspec.structs.replace(entity, values={})
    if entity.kind is not EntityKind.FILE:
        return entity
    gone = {duplicated_lines.QUANTITY.key, *of_classes}
    values = {key: value for key, value in entity.values.items() if key.partition(".")[0] not in gone}
    return msgspec.structs.replace(entity, values=values)
