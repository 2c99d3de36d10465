"""One file measured: it and its functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cache

from roslens.judge.quality.fold import fold_parts, fold_steps
from roslens.model.entity import Entity, EntityKind
from roslens.source.metrics.table import QUANTITIES, metrics_with
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts, FunctionFacts, Halstead, Lines

OfFunction = Callable[[FunctionFacts, CountingSettings], float]
OfFile = Callable[[FileFacts, CountingSettings], float | None]
OfValues = Callable[[Mapping[str, float]], float | None]

_OF_LINES: tuple[tuple[str, Callable[[Lines], float]], ...] = tuple(
    (metric.QUANTITY.key, metric.of_lines) for metric in metrics_with("of_lines")
)
_OF_HALSTEAD: tuple[tuple[str, Callable[[Halstead], float]], ...] = tuple(
    (metric.QUANTITY.key, metric.of_halstead) for metric in metrics_with("of_halstead")
)
_OF_FILE: tuple[tuple[str, OfFile], ...] = tuple(
    (metric.QUANTITY.key, metric.of_file) for metric in metrics_with("of_file")
)
_OF_FUNCTION: dict[str, tuple[tuple[str, OfFunction], ...]] = {
    "cpp": tuple((metric.QUANTITY.key, metric.of_function) for metric in metrics_with("of_function")),
    "python": tuple(
        (metric.QUANTITY.key, getattr(metric, "of_python_function", metric.of_function))
        for metric in metrics_with("of_function")
    ),
}


_FROM_FUNCTIONS = tuple(
    step for step in fold_steps(QUANTITIES.values(), EntityKind.FILE) if step.source is EntityKind.FUNCTION
)


@cache
def _of_values(kind: EntityKind) -> tuple[tuple[str, OfValues], ...]:
    return tuple(
        (metric.QUANTITY.key, metric.of_values) for metric in metrics_with("of_values") if kind in metric.QUANTITY.kinds
    )


def measure_file(path: str, facts: FileFacts, counting: CountingSettings) -> tuple[Entity, ...]:
    """Return the file, then its functions in source order, each with its values.

    Args:
        path: of the file, below the workspace root; part of every id.
        facts: what its parse yielded.
        counting: what the user chose to count.

    Returns:
        Entities whose parent is the file; classes and what they own come with the whole package.
    """
    file_id = f"file:{path}"
    of_function = _OF_FUNCTION[facts.syntax]
    functions = tuple(
        Entity(
            id=function_id,
            kind=EntityKind.FUNCTION,
            name=function.qualified_name,
            path=path,
            line=function.line,
            end_line=function.end_line,
            parent=file_id,
            approximate=function.approximate,
            values=_function_values(function, counting, of_function),
        )
        for function_id, function in zip(_function_ids(path, facts), facts.functions, strict=True)
    )
    return (
        Entity(
            id=file_id,
            kind=EntityKind.FILE,
            name=path.rpartition("/")[2],
            path=path,
            approximate=bool(facts.faults),
            values=_file_values(facts, functions, counting),
        ),
        *functions,
    )


def add_derived(kind: EntityKind, values: dict[str, float]) -> None:
    """Add to the values of an entity of ``kind`` those that follow from them."""
    for key, of_values in _of_values(kind):
        value = of_values(values)
        if value is not None:
            values[key] = float(value)


def numbered(names: Iterator[str]) -> Iterator[str]:
    """Yield the names with ``~2``, ``~3``… behind the second, third… of the same."""
    seen: dict[str, int] = {}
    for name in names:
        times = seen[name] = seen.get(name, 0) + 1
        yield name if times == 1 else f"{name}~{times}"


def _function_ids(path: str, facts: FileFacts) -> Iterator[str]:
    start = f"function:{path}#"
    return numbered(f"{start}{one.qualified_name}{_bracketed(one.signature)}" for one in facts.functions)


def _bracketed(signature: str) -> str:
    return signature if signature.startswith("(") else f"({signature})"


def _function_values(
    facts: FunctionFacts, counting: CountingSettings, of_function: tuple[tuple[str, OfFunction], ...]
) -> dict[str, float]:
    lines, halstead = facts.lines, facts.halstead
    values = {key: float(of(lines)) for key, of in _OF_LINES}
    for key, of_facts in of_function:
        values[key] = float(of_facts(facts, counting))
    for key, of_counts in _OF_HALSTEAD:
        values[key] = float(of_counts(halstead))
    add_derived(EntityKind.FUNCTION, values)
    return values


def _file_values(facts: FileFacts, functions: tuple[Entity, ...], counting: CountingSettings) -> dict[str, float]:
    values = {key: float(of(facts.lines)) for key, of in _OF_LINES}
    for key, of_file in _OF_FILE:
        value = of_file(facts, counting)
        if value is not None:
            values[key] = float(value)
    for key, of_counts in _OF_HALSTEAD:
        values[key] = float(of_counts(facts.halstead))
    values.update(fold_parts(_FROM_FUNCTIONS, functions))
    add_derived(EntityKind.FILE, values)
    return values
