"""The tables of a study, ready to be written as text, CSV or LaTeX: the same cells in each."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec

from roslens.model.study import Column, Correlation, Estimate, Figures, Study

HOLDS = {True: "holds", False: "does not hold", None: "-"}
"""What is written of a statement."""

_HEAD = ("n", "median", "mean", "SD", "min", "Q1", "Q3", "max", "threshold", "beyond")
MOST_PAIRS = 40


class StudyTable(msgspec.Struct, frozen=True):
    """A table: a key for files, a title, a header, and rows of texts; numbers stand right."""

    key: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    texts: int = 1


def tables_of(study: Study, *, complete: bool = False, grouped: bool = True) -> tuple[StudyTable, ...]:
    """Return the tables that have rows.

    Args:
        study: what they are of.
        complete: whether all pairs of quantities are in them, and not only the strongest ones.
        grouped: whether a comma stands between thousands: for readers, not for programs.
    """
    made = (
        _figures(study, grouped=grouped),
        _groups(study, grouped=grouped),
        _rules(study, grouped=grouped),
        _correlations(study, complete=complete, grouped=grouped),
        _statements(study),
    )
    return tuple(table for table in made if table.rows)


def _figures(study: Study, *, grouped: bool) -> StudyTable:
    rows = tuple(
        (study.column(one.key).title, *_cells(study.column(one.key), one, grouped=grouped)) for one in study.figures
    )
    return StudyTable("figures", "Key figures", ("quantity", *_HEAD), rows)


def _groups(study: Study, *, grouped: bool) -> StudyTable:
    rows = tuple(
        (study.column(one.key).title, one.group, *_cells(study.column(one.key), one, grouped=grouped))
        for one in study.groups
    )
    return StudyTable("groups", f"By {study.by}", ("quantity", study.by or "group", *_HEAD), rows, texts=2)


def _cells(column: Column, one: Figures, *, grouped: bool) -> tuple[str, ...]:
    figure = written(column, grouped=grouped)
    number = _number(grouped=grouped)
    beyond = "" if one.beyond is None else f"{number(one.beyond)} ({100 * one.beyond / one.n:.0f} %)"
    return (
        number(one.n),
        figure(one.median),
        figure(one.mean),
        "" if one.deviation is None else figure(one.deviation),
        figure(one.least),
        figure(one.lower),
        figure(one.upper),
        figure(one.most),
        column.threshold,
        beyond,
    )


def written(column: Column, *, grouped: bool = True) -> Callable[[float], str]:
    """Return what writes values of a column: two decimals, none where a value has none to show.

    Args:
        column: of the values.
        grouped: whether a comma stands between thousands.
    """
    decimals = max(column.decimals, 2)
    form = f"{',' if grouped else ''}.{decimals}f"

    def figure(value: float) -> str:
        text = format(value, form)
        return text.rstrip("0").rstrip(".") if round(value, decimals) == int(value) else text

    return figure


def _number(*, grouped: bool) -> Callable[[int], str]:
    """Return what writes how many there are of something."""
    return "{:,}".format if grouped else str


def _rules(study: Study, *, grouped: bool) -> StudyTable:
    roles = sorted({role for one in study.rules for role in one.by_role if role})
    number = _number(grouped=grouped)
    rows = tuple(
        (one.rule, one.kind, *map(number, (one.count, one.packages, *(one.by_role.get(role, 0) for role in roles))))
        for one in study.rules
    )
    return StudyTable("rules", "Rules that are broken", ("rule", "kind", "count", "packages", *roles), rows, texts=2)


def _correlations(study: Study, *, complete: bool, grouped: bool) -> StudyTable:
    pairs = sorted(study.correlations, key=lambda one: (-abs(one.spearman.value), one.one, one.other))
    shown = pairs if complete else pairs[:MOST_PAIRS]
    rows = tuple(_pair(study, one, grouped=grouped) for one in shown)
    left = len(pairs) - len(shown)
    title = "Correlations, strongest first" + (f" ({left} weaker ones in --format csv)" if left else "")
    head = ("quantities", "n", "Pearson", "Spearman", "Spearman, adjusted p", "size held fixed", "per line of code")
    return StudyTable("correlations", title, head, rows)


def _pair(study: Study, one: Correlation, *, grouped: bool) -> tuple[str, ...]:
    titles = f"{study.column(one.one).title} ~ {study.column(one.other).title}"
    return (
        titles,
        _number(grouped=grouped)(one.n),
        interval(one.pearson),
        interval(one.spearman),
        probability(one.spearman.adjusted),
        interval(one.partial),
        interval(one.density),
    )


def interval(estimate: Estimate | None) -> str:
    """Return ``0.91 (0.88 to 0.93)``, nothing where there is no estimate; a star where it may be chance."""
    if estimate is None:
        return ""
    star = "" if estimate.adjusted < 0.05 else "*"
    return f"{estimate.value:.2f}{star} ({estimate.low:.2f} to {estimate.high:.2f})"


def probability(p: float) -> str:
    """Return three decimals, ``< 0.001`` below."""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def _statements(study: Study) -> StudyTable:
    rows = tuple((one.says, one.found, HOLDS[one.holds]) for one in study.statements)
    return StudyTable(
        "statements",
        "Statements of section V of the paper, compared with its data",
        ("says", "data", "so"),
        rows,
        texts=3,
    )


def lead(study: Study) -> str:
    """Return a summary of the subject of the study."""
    corpus = study.corpus
    repositories = len(corpus.repositories) or len({one.repository for one in corpus.packages if one.repository})
    text = f"{_count(len(corpus.packages), 'package')} of {_count(repositories, 'repository', 'repositories')}"
    if any(column.of == "repository" for column in corpus.columns):
        text += "; commits, contributors and issues are those of repositories, all else of packages"
    return text


def _count(number: int, one: str, many: str = "") -> str:
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def wrong(statements: Sequence[bool | None]) -> int:
    """Return how many statements do not hold."""
    return sum(one is False for one in statements)
