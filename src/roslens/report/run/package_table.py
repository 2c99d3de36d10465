"""The table of packages: worst first, with as many metrics as the terminal has room for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.judge.quality.unusual import most_unusual
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.result import PackageSummary
from roslens.model.tags import TagFilter
from roslens.report.writing.terminal import Terminal, columns, left, right

NAME_WIDTH = 40
_NAME_LEAST = 22
_AROUND = 2


_FIELD = "field"
"""Where the package stands in the field, in what of it is most unusual: no quantity of its own."""


class _Metric(msgspec.Struct, frozen=True):
    """A column: the quantity, its heading, what stands behind the number, and how dear it is (0: dearest)."""

    quantity: str
    head: str
    rank: int
    unit: str = ""

    @property
    def worst(self) -> bool:
        """Whether it shows the worst part of the package rather than the package as a whole."""
        return self.quantity.endswith(".max")


_METRICS = (
    _Metric("loc", "lines", 0),
    _Metric("cyclomatic_complexity.max", "complexity", 1),
    _Metric("cognitive_complexity.max", "cognitive", 6),
    _Metric("nesting.max", "nesting", 4),
    _Metric("cbo.max", "coupling", 5),
    _Metric("comment_ratio", "comments", 3, " %"),
    _Metric("duplication_ratio", "duplicated", 7, " %"),
    _Metric("dependents", "dependents", 8),
    _Metric(_FIELD, "field", 2, " %"),
)


class PackageCounts(msgspec.Struct, frozen=True):
    """A package with the findings that count, by severity."""

    package: PackageSummary
    counts: dict[Severity, int]

    @property
    def total(self) -> int:
        """All findings that count."""
        return sum(self.counts.values())


def count_packages(packages: Iterable[PackageSummary], tags: TagFilter) -> list[PackageCounts]:
    """Return the packages with their findings, worst first."""
    counted = []
    for package in packages:
        counts = dict.fromkeys(Severity, 0)
        for rule in package.rules:
            if tags.matches(rule.tags):
                counts[rule.severity] += rule.gated
        counted.append(PackageCounts(package, counts))
    return sorted(counted, key=_badness)


def package_table(terminal: Terminal, shown: Sequence[PackageCounts], everything: Sequence[PackageCounts]) -> list[str]:
    """Return the lines of the table.

    Args:
        terminal: where it is shown.
        shown: the packages, in this order.
        everything: all packages; a column that is empty for all of them is left out.
    """
    severities = [
        severity for severity in reversed(Severity) if any(counted.counts[severity] for counted in everything)
    ]
    metrics = [
        metric for metric in _METRICS if any(_value(metric, counted.package) is not None for counted in everything)
    ]
    names = [terminal.clean(counted.package.id) for counted in shown]
    longest = max(len("package"), *map(columns, names))
    taken = {metric.head: _metric_width(terminal, metric, shown) for metric in metrics}
    counts = [(severity, _count_width(severity, shown)) for severity in severities]
    room = terminal.width - 3 - sum(width + _AROUND for _severity, width in counts)
    metrics = _fitting(metrics, taken, room - min(longest, _NAME_LEAST))
    room -= sum(taken[metric.head] + _AROUND for metric in metrics)
    name_width = min(longest, NAME_WIDTH, room)
    heads = [(f"{severity.value}s", width) for severity, width in counts]
    heads += [(metric.head, taken[metric.head]) for metric in metrics]
    head = left("package", name_width + 1) + "".join(_cell(text, width) for text, width in heads)
    lines = [terminal.paint("  " + head.rstrip(), "quiet")]
    for name, counted in zip(names, shown, strict=True):
        line = left(terminal.cut(name, name_width), name_width + 1)
        line += "".join(_count_cell(terminal, severity, counted, width) for severity, width in counts)
        line += "".join(_metric_cell(terminal, metric, counted, taken[metric.head]) for metric in metrics)
        lines.append("  " + line.rstrip())
    lines.extend(_legend(terminal, metrics, shown))
    return lines


def _badness(counted: PackageCounts) -> tuple[int, int, int, str]:
    counts = counted.counts
    return (-counts[Severity.ERROR], -counts[Severity.WARNING], -counts[Severity.NOTE], counted.package.id)


def _fitting(metrics: Sequence[_Metric], widths: dict[str, int], room: int) -> list[_Metric]:
    kept = set()
    for metric in sorted(metrics, key=lambda metric: metric.rank):
        room -= widths[metric.head] + _AROUND
        if room < 0:
            break
        kept.add(metric.head)
    return [metric for metric in metrics if metric.head in kept]


def _count_width(severity: Severity, shown: Iterable[PackageCounts]) -> int:
    widths = (len(f"{counted.counts[severity]:,}") for counted in shown)
    return max(len(severity.value) + 1, max(widths, default=0))


def _metric_width(terminal: Terminal, metric: _Metric, shown: Iterable[PackageCounts]) -> int:
    widths = (len(_number(terminal, metric, counted.package)) for counted in shown)
    return max(len(metric.head), max(widths, default=0))


def _cell(text: str, width: int, sign: str = " ") -> str:
    """Return a column: a blank in front, and room behind for the sign that the number is beyond a bound."""
    return f" {right(text, width)}{sign}"


def _count_cell(terminal: Terminal, severity: Severity, counted: PackageCounts, width: int) -> str:
    count = counted.counts[severity]
    text = f"{count:,}" if count else terminal.glyph("zero")
    return _cell(text, width).replace(text, terminal.paint(text, severity.value if count else "quiet"))


def _metric_cell(terminal: Terminal, metric: _Metric, counted: PackageCounts, width: int) -> str:
    sign = terminal.paint(terminal.glyph("high"), "high") if _is_beyond(metric, counted.package) else " "
    return _cell(_number(terminal, metric, counted.package), width, sign)


def _number(terminal: Terminal, metric: _Metric, package: PackageSummary) -> str:
    value = _value(metric, package)
    return terminal.glyph("none") if value is None else f"{value:,.0f}{metric.unit}"


def _value(metric: _Metric, package: PackageSummary) -> float | None:
    if metric.quantity != _FIELD:
        return package.values.get(metric.quantity)
    found = most_unusual(EntityKind.PACKAGE, package.values)
    return found.percentile if found else None


def _is_beyond(metric: _Metric, package: PackageSummary) -> bool:
    """Return whether a quality model found the worst part of the package too high."""
    if not metric.worst:
        return False
    wanted = f".{metric.quantity}"
    return any(rule.rule.endswith(wanted) for rule in package.rules)


def _legend(terminal: Terminal, metrics: Sequence[_Metric], shown: Iterable[PackageCounts]) -> Iterator[str]:
    if any(metric.quantity == _FIELD for metric in metrics):
        what = "field: percentile among ROS packages, of the most unusual value; `roslens percentile`"
        yield from (terminal.paint(line, "quiet") for line in terminal.wrap(what, "  "))
    heads = [metric.head for metric in metrics if metric.worst]
    if not heads:
        return
    text = f"{', '.join(heads)}: the worst function or class"
    if any(_is_beyond(metric, counted.package) for metric in metrics for counted in shown):
        text += f"; {terminal.glyph('high')} beyond a bound of a quality model"
    yield from (terminal.paint(line, "quiet") for line in terminal.wrap(text, "  "))
