"""The overview: how the run ended, what to look at first, what was analysed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.line_chart import day
from roslens.dashboard.computation.graph_page import alike
from roslens.dashboard.site import Site
from roslens.dashboard.tables.field_column import field_cell, field_column
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.view import Request, View
from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.quality_model import QualityModel, rule_id
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.result import RuleCount
from roslens.model.source import OUTSIDE_PACKAGES, number_of_packages
from roslens.model.tags import TagFilter
from roslens.model.words.plural import plural
from roslens.report.run.finding_text import weight_of
from roslens.report.run.fix_first import first_to_fix, new_before_others
from roslens.report.run.grave_findings import grave_findings

FIRST = 8
ELSEWHERE = "In test, generated or vendored code: they fail no check"


def build(site: Site, request: Request) -> View | None:  # noqa: ARG001 - the shape of every page
    """Return the page."""
    severities = site.severity_counts()
    aside = sum(one.count - one.gated for one in site.rule_totals())
    own = sum(severities.values())
    broken = {package.id for package in site.packages if any(count.gated for count in package.rules)}
    packages = number_of_packages(site.by_id)
    copies = [package for package in site.packages if package.copy_of]
    counts = {
        "packages": packages,
        "files": sum(package.files for package in site.packages),
        "classes": sum(package.classes for package in site.packages),
        "functions": sum(package.functions for package in site.packages),
        "loc": int(sum(package.values.get("loc", 0) for package in site.packages)),
        "findings": own + aside,
        "own": own,
        "aside": aside,
        "failures": len(site.failures),
    }
    header = site.view.header
    return View(
        ref=PageRef("overview"),
        title="Overview",
        facts={
            "headline": headline(severities, number_of_packages(broken), packages, outside=OUTSIDE_PACKAGES in broken),
            "counts": counts,
            "gate": msgspec.to_builtins(site.gate) if site.gate else None,
            "since_run": _since_run(site),
            "copies": [{"id": one.id, "of": one.copy_of} for one in copies[:FIRST]],
            "copied": len(copies),
            "first": [
                {
                    "severity": one.severity.value,
                    "rule": one.rule,
                    "text": one.example,
                    "place": _place(one) if one.path in site.places else None,
                    "new": one in site.new_first,
                    "commits": site.changes.get(one.path, 0),
                    "weight": weight_of(one.weight, site.rules.get(one.rule)),
                    "also": list(one.also),
                }
                for one in _first(site)
            ],
            "severities": {severity.value: count for severity, count in severities.items()},
            "languages": dict(_sum(package.languages for package in site.packages)),
            "roles": dict(_sum(package.roles for package in site.packages)),
            "paths": list(header.paths),
            "seconds": header.seconds,
            "tools": dict(header.tools),
        },
        tables=(_worst(site), _rules(site), _conditions(site)),
        shown={
            "severities": severities,
            "counts": counts,
            "since": since_release(site),
            "systems": alike(site.book.systems.values()),
        },
    )


def _since_run(site: Site) -> dict[str, object] | None:
    since = site.since
    return {"name": since.name, "new": since.added, "resolved": since.resolved} if since is not None else None


def since_release(site: Site) -> dict[str, object] | None:
    """Return what is different since the last release; None where no past revision is one."""
    past = site.past
    release = past.last_release if past is not None else None
    if past is None or release is None:
        return None
    last = len(past.points) - 1
    found = past.difference(release, last)
    before, after = past.points[release], past.points[last]
    loc = past.known("loc")
    ends = [loc.whole[place] for place in (release, last)] if loc is not None else []
    known = [one for one in ends if one is not None]
    return {
        "name": before.name,
        "until": after.name,
        "date": day(before),
        "new": len(found.findings.new),
        "resolved": len(found.findings.gone),
        "loc": f"{known[1] - known[0]:+,.0f}" if len(known) == 2 else "",
        "ref": PageRef("difference", query=(("before", before.commit), ("after", after.commit))),
    }


def _first(site: Site) -> tuple[RuleCount, ...]:
    findings, grave = site.view.workspace.findings, grave_findings(site.view)
    others = first_to_fix(site.packages, findings, site.rules, TagFilter(), site.changes, grave)
    return new_before_others(site.new_first, others)


def _place(one: RuleCount) -> dict[str, object] | None:
    """Return where a finding is, as its text writes it; None where that names no line."""
    found = re.search(rf"{re.escape(one.path)}(?::(\d+))?(?![\w/.])", one.example) if one.path else None
    return {"path": one.path, "line": int(found[1] or 0), "text": found[0]} if found is not None else None


def headline(severities: Mapping[Severity, int], affected: int, packages: int, *, outside: bool = False) -> str:
    """Return the summary of the report: the findings that count for gates, as in the terminal."""
    amounts = [plural(count, severity.value) for severity, count in severities.items() if count]
    if not packages and not amounts:
        return "No package was found."
    if not amounts:
        return f"No findings in {plural(packages, 'package')}."
    beside = " and outside of packages" if outside else ""
    return f"{', '.join(amounts)} in {affected:,} of {plural(packages, 'package')}{beside}."


def _sum(counts: Iterable[dict[str, int]]) -> list[tuple[str, int]]:
    total: Counter[str] = Counter()
    for count in counts:
        total.update(count)
    return sorted(total.items(), key=lambda item: (-item[1], item[0]))


def _worst(site: Site) -> Table:
    rows = []
    for package in site.packages:
        by_severity = site.severity_counts_of(package)
        total, aside = sum(by_severity.values()), site.aside_of(package)
        # Those that have findings in other code only are no part of the headline, either.
        if total:
            rows.append((package, by_severity, total, aside))
    rows.sort(key=lambda row: (-row[2], -row[3], row[0].id))
    columns = (
        Column("package", "Package"),
        Column("findings", "Findings", "number", bar=True),
        Column("errors", "Errors", "number"),
        Column("warnings", "Warnings", "number"),
        Column("notes", "Notes", "number", optional=True),
        Column("aside", "Elsewhere", "number", hint=ELSEWHERE),
        field_column(EntityKind.PACKAGE, optional=True),
        Column("loc", "Code lines", "number", optional=True),
    )
    cells = tuple(
        (
            Cell(package.id, ref=PageRef("package", package.id)),
            Cell(total, ref=_listed(package.id, "gated") if total else None),
            Cell(by_severity[Severity.ERROR]),
            Cell(by_severity[Severity.WARNING]),
            Cell(by_severity[Severity.NOTE]),
            Cell(aside, ref=_listed(package.id, "aside") if aside else None),
            field_cell(EntityKind.PACKAGE, package.values, site.quantities),
            Cell(package.values.get("loc")),
        )
        for package, by_severity, total, aside in rows[:FIRST]
    )
    return Table(
        "worst",
        "Packages with most findings",
        columns,
        cells,
        total=len(rows),
        empty="No findings.",
        all=PageRef("packages"),
    )


def _listed(package: str, role: str) -> PageRef:
    return PageRef("findings", query=(("package", package), ("role", role)))


def _rules(site: Site) -> Table:
    totals = site.broken_rules()
    columns = (
        Column("severity", "Severity", "mark"),
        Column("rule", "Rule"),
        Column("findings", "Findings", "number", bar=True),
        Column("aside", "Elsewhere", "number", hint=ELSEWHERE),
        Column("packages", "Packages", "number"),
    )
    rows = tuple(
        (
            Cell(total.severity.value),
            Cell(total.rule, text=site.rules[total.rule].title, ref=PageRef("rule", total.rule), hint=total.rule),
            Cell(total.gated, ref=PageRef("findings", query=(("rule", total.rule), ("role", "gated")))),
            Cell(total.count - total.gated),
            Cell(total.packages),
        )
        for total in totals[:FIRST]
    )
    return Table(
        "rules",
        "Rules broken, most severe first",
        columns,
        rows,
        total=len(totals),
        empty="None.",
        all=PageRef("rules"),
    )


def _beyond(count: int, kind: str, side: str) -> str:
    """Return ``12 files below``."""
    many = {"class": "classes"}.get(kind, "")
    return f"{plural(count, kind, many)} {'above' if side == 'max' else 'below'}" if count else "none"


def _conditions(site: Site) -> Table:
    """What the run's models ask, and how often it does not hold."""
    counts: Counter[str] = Counter()
    for _, count in site.counts():
        counts[count.rule] += count.gated
    among: Counter[str] = Counter()
    for package in site.packages:
        among.update(package.limits)
    rows = []
    for model in site.run_models:
        for constraint in model.constraints:
            for side in constraint.sides:
                rule = rule_id(model, constraint, side)
                rows.append(_condition(model, constraint, side, counts[rule], among[rule]))
    columns = (
        Column("rating", "Rating", "mark"),
        Column("quantity", "Quantity"),
        Column("bound", "Limit"),
        Column("model", "Model"),
        Column("broken", "Own code beyond it", "number"),
    )
    return Table("conditions", "Limits", columns, tuple(rows), total=len(rows), empty="No models.")


def _condition(model: QualityModel, constraint: Constraint, side: str, alone: int, among: int) -> tuple[Cell, ...]:
    """Return the row of a limit, which ``alone`` findings are beyond, and ``among`` that break others as well."""
    broken = alone + among
    metric = PageRef("metric", constraint.quantity, query=(("kind", constraint.kind.value),))
    # The page of a rule has those that break nothing else.
    beyond = PageRef("rule", rule_id(model, constraint, side)) if broken else None
    return (
        Cell("high" if side == "max" else "low") if broken else Cell("ok"),
        Cell(_of_what(constraint.subject or constraint.quantity, constraint.kind.value), ref=metric),
        Cell(constraint.limit_text(side)),
        Cell(model.name),
        Cell(broken, text=_beyond(broken, constraint.kind.value, side), ref=metric if among else beyond),
    )


def _of_what(subject: str, kind: str) -> str:
    return subject if subject.endswith(kind) else f"{subject} of a {kind}"
