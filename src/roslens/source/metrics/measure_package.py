"""One package measured: it, its files, classes and functions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence

from msgspec.structs import replace

from roslens.judge.quality.fold import fold_parts, fold_steps
from roslens.model.entity import Entity, EntityKind
from roslens.model.source import Package, Role, SourceFile
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.class_model.join_classes import JoinedClasses, join_classes
from roslens.source.metrics.measure_file import add_derived, numbered
from roslens.source.metrics.size import duplicated_lines, files
from roslens.source.metrics.table import QUANTITIES, metrics_with
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts

MeasuredFile = tuple[SourceFile, FileFacts, tuple[Entity, ...]]
"""A file, its facts and what :func:`~roslens.source.metrics.measure_file.measure_file` made of them."""

_OF_CLASS: tuple[tuple[str, Callable[[ClassInPackage, CountingSettings], float | None]], ...] = tuple(
    (metric.QUANTITY.key, metric.of_class) for metric in metrics_with("of_class")
)
_FROM_CLASSES = tuple(
    step for step in fold_steps(QUANTITIES.values(), EntityKind.FILE) if step.source is EntityKind.CLASS
)
_TO_PACKAGE = fold_steps(QUANTITIES.values(), EntityKind.PACKAGE)


def measure_package(
    package: Package, measured: Sequence[MeasuredFile], counting: CountingSettings
) -> tuple[Entity, ...]:
    """Return the package, then of each file itself, its classes and its functions.

    The package's values are those of its own code: files in another role than ``own`` have values but
    do not go into the package's. Without own code it has counts of 0 and nothing else.

    Args:
        package: its manifest.
        measured: its source files in a fixed order.
        counting: what the user chose to count.
    """
    joined = join_classes([(file, facts) for file, facts, _ in measured])
    class_ids = _class_ids(measured)
    duplicated = _duplicated(measured, counting)
    entities: list[Entity] = []
    own: list[Entity] = []
    package_id = f"package:{package.id}"
    for number, (file, facts, of_file) in enumerate(measured):
        classes = tuple(_classes(number, file.path, facts, class_ids, joined, counting))
        functions = _functions(number, of_file[1:], class_ids, joined)
        values = {**of_file[0].values, duplicated_lines.QUANTITY.key: duplicated[number]}
        values.update(fold_parts(_FROM_CLASSES, classes))
        add_derived(EntityKind.FILE, values)
        parts = (replace(of_file[0], parent=package_id, values=values), *classes, *functions)
        entities.extend(parts)
        if file.role is Role.OWN:
            own.extend(parts)
    whole = Entity(
        id=package_id,
        kind=EntityKind.PACKAGE,
        name=package.name,
        path=package.path,
        values=_package_values([file for file, _, _ in measured], own),
    )
    return (whole, *entities)


def _package_values(sources: Iterable[SourceFile], own: Sequence[Entity]) -> dict[str, float]:
    of_files = float(files.of_files([file for file in sources if file.role is Role.OWN]))
    values = {files.QUANTITY.key: of_files}
    folded = fold_parts(_TO_PACKAGE, own)
    values.update(folded or dict.fromkeys(("classes", "functions", "loc"), 0.0))
    add_derived(EntityKind.PACKAGE, values)
    return values


def _class_ids(measured: Sequence[MeasuredFile]) -> list[list[str]]:
    return [
        list(numbered(f"class:{file.path}#{one.qualified_name}" for one in facts.classes))
        for file, facts, _ in measured
    ]


def _classes(
    number: int,
    path: str,
    facts: FileFacts,
    class_ids: list[list[str]],
    joined: JoinedClasses,
    counting: CountingSettings,
) -> Iterator[Entity]:
    for place, one in enumerate(facts.classes):
        subject = joined.classes[number, place]
        values = {}
        for key, of_class in _OF_CLASS:
            value = of_class(subject, counting)
            if value is not None:
                values[key] = float(value)
        yield Entity(
            id=class_ids[number][place],
            kind=EntityKind.CLASS,
            name=one.qualified_name,
            path=path,
            line=one.line,
            end_line=one.end_line,
            parent=f"file:{path}",
            approximate=one.approximate or any(body.approximate for body in subject.bodies),
            values=values,
        )


def _functions(
    number: int, functions: Sequence[Entity], class_ids: list[list[str]], joined: JoinedClasses
) -> Iterator[Entity]:
    for place, function in enumerate(functions):
        owner = joined.owners.get((number, place))
        yield function if owner is None else replace(function, parent=class_ids[owner[0]][owner[1]])


def _duplicated(measured: Sequence[MeasuredFile], counting: CountingSettings) -> list[float]:
    by_role: defaultdict[Role, list[int]] = defaultdict(list)
    for number, (file, _, _) in enumerate(measured):
        by_role[file.role].append(number)
    lines = [0.0] * len(measured)
    for numbers in by_role.values():
        hashes = [measured[number][1].line_hashes for number in numbers]
        for number, value in zip(numbers, duplicated_lines.of_files(hashes, counting.duplicate_lines), strict=True):
            lines[number] = float(value)
    return lines
