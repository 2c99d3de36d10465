"""Where packages stand in the field: of each quantity the percentile among all, and among those of the same kind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import StringIO

import msgspec

from roslens.judge.quality.field import Distribution, Field
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.model.result import PackageSummary
from roslens.model.words.plural import plural
from roslens.report.writing.csv_table import write_rows

UNUSUAL = 90.0
"""From this percentile on, on the side that is worse, a value is unusual."""


class Among(msgspec.Struct, frozen=True):
    """A percentile among ``n`` packages of a group (``""``: all)."""

    group: str
    n: int
    percentile: float


class Standing(msgspec.Struct, frozen=True):
    """A value of a package with its percentiles; ``worse`` of a hundred packages is how many do better.

    ``worse`` is None where neither way is better.
    """

    package: str
    quantity: str
    title: str
    unit: str
    value: float
    among: tuple[Among, ...]
    worse: float | None


def standings_of(
    summary: PackageSummary, quantities: Sequence[Quantity], field: Field, groups: Sequence[str] = ()
) -> Iterator[Standing]:
    """Yield a standing for each value of a package that the field knows, in the order of quantities.

    Args:
        summary: of the package.
        quantities: of the run.
        field: to compare with.
        groups: further groups of the field that the package belongs to.
    """
    for quantity in quantities:
        keys = [quantity.key, *(f"{quantity.key}.{fold.value}" for fold in quantity.folds[1:])]
        for key in keys:
            everything = field.find(key, EntityKind.PACKAGE)
            if key not in summary.values or everything is None:
                continue
            value = summary.values[key]
            narrower = (field.find(key, EntityKind.PACKAGE, group) for group in groups)
            among = tuple(_among(one, value) for one in (everything, *narrower) if one is not None)
            title = quantity.title + (f", {key.rpartition('.')[2]}" if key != quantity.key else "")
            yield Standing(
                summary.id, key, title, quantity.unit, value, among, _worse(quantity.better, among[0].percentile)
            )


def _among(distribution: Distribution, value: float) -> Among:
    return Among(distribution.group, distribution.n, round(distribution.percentile(value), 1))


def _worse(better: Better, percentile: float) -> float | None:
    if better is Better.NEITHER:
        return None
    return percentile if better is Better.LOWER else round(100 - percentile, 1)


def standings_text(found: Sequence[Standing], field: Field, *, complete: bool) -> str:
    """Return a line for each standing, by package; only what is unusual unless ``complete``."""
    shown = [one for one in found if complete or (one.worse is not None and one.worse >= UNUSUAL)]
    lines = [
        (
            f"among {field.packages:,} packages of {len(field.repositories)} repositories ({field.name}, {field.day}); "
            "a percentile is the share of packages with a smaller value"
        )
    ]
    widths = (max((len(one.title) for one in shown), default=0), max((len(_value(one)) for one in shown), default=0))
    package = ""
    for one in shown:
        if one.package != package:
            package = one.package
            lines += ["", package]
        among = ", ".join(f"{each.percentile:.0f} of {_group(each)}" for each in one.among)
        mark = "!" if one.worse is not None and one.worse >= UNUSUAL else " "
        lines.append(f"{mark} {one.title.ljust(widths[0])}  {_value(one).rjust(widths[1])}  {among}")
    if not shown:
        lines += ["", "nothing is unusual" if found else "no value that the field knows"]
    hidden = len({one.package for one in found}) - len({one.package for one in shown})
    if not complete and hidden:
        lines += ["", f"{plural(hidden, 'package')} without anything unusual; --all shows everything"]
    return "\n".join(lines) + "\n"


def _value(one: Standing) -> str:
    return f"{one.value:.4g} {one.unit}".strip()


def _group(among: Among) -> str:
    return f"{among.group.partition('=')[2] or 'all'} ({among.n})"


def standings_csv(found: Sequence[Standing]) -> str:
    """Return a row for each standing and group."""
    out = StringIO(newline="")
    rows = (
        (one.package, one.quantity, one.value, each.group, each.n, each.percentile)
        for one in found
        for each in one.among
    )
    write_rows((("package", "quantity", "value", "group", "n", "percentile"), rows), out)
    return out.getvalue()


def standings_json(found: Sequence[Standing], field: Field) -> str:
    """Return the standings with what the field is."""
    head = {"name": field.name, "day": field.day, "packages": field.packages, "repositories": len(field.repositories)}
    document = {"schema": 1, "field": head, "standings": found}
    return msgspec.json.format(msgspec.json.encode(document)).decode() + "\n"
