"""The reference page of all metrics, written from their declarations.

``python -m roslens.source.metrics.describe docs/reference/metrics/quantities.md`` writes it anew.
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

What roslens measures of source code, one section per metric. This page is made from the declarations in
`src/roslens/source/metrics/`; `make docs` writes it anew.

- The **key** stands in models, in JSON and CSV.
- **Measured on** says which entities have a value of their own; **goes up as** how it becomes a value of the file
  and the package around them, and under which keys. Where nothing goes up, a file or package has a value only if it
  is measured on it.
- A value is *absent*, not zero, where there is nothing to measure.
- The values of a package are those of its own code: tests, generated and vendored files have values, but none of
  them goes into their package's.
- `counting.lambdas`, `counting.alternatives` and `counting.duplicate_lines` are set in `roslens.toml`.

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
    """Return what the page says of one metric."""
    rows = {
        "Title": quantity.title,
        "Unit": quantity.unit or "none, a number",
        "Measured on": _kinds(quantity.kinds),
        "Goes up as": _folds(quantity),
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
