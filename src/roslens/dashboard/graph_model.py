"""The package graph as one library-neutral value: places, dependencies, counts by rule, metrics."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from weakref import WeakKeyDictionary

import msgspec

from roslens.dashboard.charts.figures import compact
from roslens.dashboard.layout.lay_out import DRAWN_UP_TO, Layout, Node, lay_out
from roslens.dashboard.measured import Measured, measured_on
from roslens.dashboard.site import Site
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better
from roslens.model.result import PackageSummary
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.tags import TagFilter

SMALLEST, LARGEST = 8.0, 30.0
LONGEST_LABEL = 30
_CHARACTER = 6.9


class RuleKind(msgspec.Struct, frozen=True):
    """A rule as findings carry it; ``tags`` are numbers into the graph's tags."""

    rule: str
    severity: str
    tags: tuple[int, ...]
    title: str


class GraphNode(msgspec.Struct, frozen=True):
    """A package: place, radius, tier, what it needs (numbers of nodes), (rule kind, findings, gated) triples."""

    id: str
    label: str
    x: float
    y: float
    r: float
    tier: int
    column: int
    cycle: int
    loc: float | None
    needs: tuple[int, ...]
    counts: tuple[tuple[int, int, int], ...]


class GraphMetric(msgspec.Struct, frozen=True):
    """A quantity that can colour the graph: one value per node, None where it was not measured."""

    key: str
    title: str
    unit: str
    decimals: int
    better: str
    values: tuple[float | None, ...]


class PackageGraph(msgspec.Struct, frozen=True):
    """Everything that the picture and its twin need; ``edges`` are drawn ones as (dependent, needed)."""

    width: float
    height: float
    nodes: tuple[GraphNode, ...]
    edges: tuple[tuple[int, int], ...]
    tags: tuple[str, ...]
    rules: tuple[RuleKind, ...]
    metrics: tuple[GraphMetric, ...]
    all_edges_drawn: bool


_made: WeakKeyDictionary[Site, tuple[PackageGraph, Layout]] = WeakKeyDictionary()


def pictured(site: Site) -> tuple[PackageSummary, ...]:
    """Return what has a disc: packages, and not what is in none."""
    return tuple(package for package in site.packages if package.id != OUTSIDE_PACKAGES)


def graph_of(site: Site) -> tuple[PackageGraph, Layout]:
    """Return the graph of the site's packages and the layout with the paths of its edges; made once for each site."""
    found = _made.get(site)
    if found is None:
        found = _made[site] = _graph_of(site)
    return found


def _graph_of(site: Site) -> tuple[PackageGraph, Layout]:
    packages = pictured(site)
    place = {package.id: number for number, package in enumerate(packages)}
    needs = [
        tuple(place[needed] for needed in site.dependencies[package.id] if needed in place) for package in packages
    ]
    radii = _radii([package.values.get("loc") for package in packages])
    labels = [_label(package.id) for package in packages]
    layout = lay_out(
        [Node(radius, len(label) * _CHARACTER) for radius, label in zip(radii, labels, strict=True)],
        [(number, target) for number, targets in enumerate(needs) for target in targets],
    )
    tags, rules, counts = _counts(packages, {rule.id: rule.title for rule in site.rules.values()})
    nodes = tuple(
        GraphNode(
            id=package.id,
            label=labels[number],
            x=layout.places[number][0],
            y=layout.places[number][1],
            r=radii[number],
            tier=layout.tiers[number],
            column=layout.columns[number],
            cycle=layout.cycles[number],
            loc=package.values.get("loc"),
            needs=needs[number],
            counts=counts[number],
        )
        for number, package in enumerate(packages)
    )
    graph = PackageGraph(
        width=layout.width,
        height=layout.height,
        nodes=nodes,
        edges=layout.reduced,
        tags=tags,
        rules=rules,
        metrics=_metrics(site),
        all_edges_drawn=len(nodes) <= DRAWN_UP_TO,
    )
    return graph, layout


def _radii(sizes: Sequence[float | None]) -> list[float]:
    """Return radii so that areas beyond the smallest grow with the lines of code."""
    most = max((size for size in sizes if size), default=1.0)
    return [round(SMALLEST + (LARGEST - SMALLEST) * math.sqrt(max(0.0, size or 0.0) / most), 1) for size in sizes]


def _label(name: str) -> str:
    if len(name) <= LONGEST_LABEL:
        return name
    return name[: LONGEST_LABEL - 1] + "\N{HORIZONTAL ELLIPSIS}"


def _counts(
    packages: Sequence[PackageSummary], titles: Mapping[str, str]
) -> tuple[tuple[str, ...], tuple[RuleKind, ...], list[tuple[tuple[int, int, int], ...]]]:
    tags: dict[str, int] = {}
    kinds: dict[tuple[str, str, tuple[str, ...]], int] = {}
    rules: list[RuleKind] = []
    counts = []
    for package in packages:
        found = []
        for count in package.rules:
            key = (count.rule, count.severity.value, count.tags)
            if key not in kinds:
                kinds[key] = len(rules)
                numbers = tuple(tags.setdefault(tag, len(tags)) for tag in count.tags)
                rules.append(RuleKind(count.rule, count.severity.value, numbers, titles[count.rule]))
            found.append((kinds[key], count.count, count.gated))
        counts.append(tuple(found))
    return tuple(tags), tuple(rules), counts


def _metrics(site: Site) -> tuple[GraphMetric, ...]:
    found = []
    for key, measured in measured_on(site.quantities, EntityKind.PACKAGE).items():
        values = tuple(_short(package.values.get(key)) for package in pictured(site))
        if any(value is not None for value in values):
            quantity = measured.quantity
            found.append(
                GraphMetric(key, measured.title, quantity.unit, measured.decimals, quantity.better.value, values)
            )
    return tuple(found)


def _short(value: float | None) -> float | None:
    """Return the value with no more digits than a reader or a colour can distinguish."""
    if value is None or not math.isfinite(value):
        return None
    return value if value == int(value) else float(compact(value))


class Colouring(msgspec.Struct, frozen=True):
    """What colours the graph: ``findings``, ``kloc`` or ``metric:<key>``; which findings count."""

    by: str = "findings"
    tags: TagFilter = TagFilter()
    gated: bool = True


def colour_values(site: Site, colouring: Colouring) -> tuple[list[float | None], Measured | None]:
    """Return one value per package, and the quantity where one colours."""
    if colouring.by.startswith("metric:"):
        key = colouring.by.removeprefix("metric:")
        measured = measured_on(site.quantities, EntityKind.PACKAGE).get(key)
        if measured:
            return [_short(package.values.get(key)) for package in pictured(site)], measured
    if colouring.by == "kloc":
        return [site.findings_per_kloc(package, colouring.tags) for package in pictured(site)], None
    return [float(_total(package, colouring)) for package in pictured(site)], None


def _total(package: PackageSummary, colouring: Colouring) -> int:
    return sum(
        count.gated if colouring.gated else count.count for count in package.rules if colouring.tags.matches(count.tags)
    )


def colour_title(colouring: Colouring, measured: Measured | None) -> str:
    """Return what the colours stand for."""
    if measured:
        return measured.title
    if colouring.by == "kloc":
        return "Findings per 1,000 lines of own code"
    return "Findings in own code" if colouring.gated else "Findings in all code"


def better_of(measured: Measured | None) -> Better:
    """Return which way the colouring value improves: fewer findings are better."""
    return measured.better if measured else Better.LOWER
