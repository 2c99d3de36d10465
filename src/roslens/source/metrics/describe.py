"""The reference page of all metrics, written from their declarations.

``python -m roslens.source.metrics.describe docs/reference/metrics/quantities.md`` regenerates it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from roslens.judge.quality.fold import folded_keys
from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity

_HEAD = """\
# Metrics

The metrics of source code, one section each. `make docs` generates this page from the declarations in
`src/roslens/source/metrics/`.

- The **key** identifies a metric in models, JSON and CSV.
- **Measured on** lists the kinds of entities that have values of their own; **aggregated as** lists how these are
  combined into a value of the enclosing file and package, and its key. Without an aggregation, a file or package has
  a value only if the metric is measured on it.
- A value is *absent*, not zero, where there is nothing to measure.
- The values of a package cover its own code: tests, generated and vendored files have values of their own, but do not
  contribute to those of their package.
- `counting.lambdas`, `counting.alternatives` and `counting.duplicate_lines` are options in `roslens.toml`.

"""


def metrics_page(quantities: Iterable[Quantity]) -> str:
    """Return the reference page of ``quantities`` in Markdown."""
    quantities = tuple(quantities)
    overview = ["| key | metric | unit | measured on | better |", "| --- | --- | --- | --- | --- |"]
    overview += [
        f"| [`{one.key}`](#{one.key}) | {one.title} | {one.unit} | {_kinds(one.kinds)} | {one.better.value} |"
        for one in quantities
    ]
    return _HEAD + "\n".join([*overview, "", *map(section, quantities)])


def section(quantity: Quantity) -> str:
    """Return the section on one metric."""
    rows = {
        "Title": quantity.title,
        "Unit": quantity.unit or "dimensionless",
        "Measured on": _kinds(quantity.kinds),
        "Aggregated as": _folds(quantity),
        "Better": quantity.better.value,
        "Range": _range(quantity),
        "Formula": quantity.formula,
        "Source": quantity.source,
        "Limits": quantity.limits,
    }
    lines = [f"## {quantity.key}", "", quantity.text, ""]
    lines += [f"- **{name}**: {text}" for name, text in rows.items() if text]
    return "\n".join([*lines, ""])


def _kinds(kinds: Sequence[EntityKind]) -> str:
    return ", ".join(kind.value for kind in kinds)


def _folds(quantity: Quantity) -> str:
    keys = zip(folded_keys(quantity), quantity.folds, strict=True)
    return ", ".join(f"{how.value} (`{key}`)" for key, how in keys)


def _range(quantity: Quantity) -> str:
    if quantity.maximum is None:
        return "" if quantity.minimum is None else f"{quantity.minimum:g} or more"
    return f"{quantity.minimum:g} to {quantity.maximum:,.15g}"


def main(arguments: Sequence[str]) -> None:
    """Write the page of all metrics to the path given."""
    from roslens.source.metrics.table import QUANTITIES

    Path(arguments[0]).write_text(metrics_page(QUANTITIES.values()), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
