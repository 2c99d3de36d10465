"""Runs that were kept as one corpus: what was measured of their packages, and which rules these break."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import msgspec

from roslens.judge.quality.quality_model import QualityModel
from roslens.model.errors import UsageError
from roslens.model.quantity import Quantity
from roslens.model.result import PackageSummary
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.study import REPOSITORY, Broken, Corpus, Subject
from roslens.source.study.columns import column_of, size_among
from roslens.store.read import RunView

KIND = "runs"
_SIZES = ("loc", "comment_lines", "dependents", "rqv", "rcv")
RoleOf = Callable[[RunView, PackageSummary], str]
"""Returns the role of a package."""


def corpus_of_runs(
    runs: Sequence[tuple[str, RunView]],
    models: Sequence[QualityModel],
    role_of: RoleOf,
    wanted: Sequence[str] = (),
) -> Corpus:
    """Return the corpus of runs; values of histories are of repositories, all others of packages.

    Args:
        runs: each with the name of its distribution, by which several can be distinguished.
        models: whose bounds are thresholds.
        role_of: says which role a package has.
        wanted: keys of quantities; none for sizes, findings, and whatever the models bound.

    Raises:
        UsageError: a quantity is known to no run, or no package has any value.
        StoreError: a store cannot be read.
    """
    known = {one.key: one for _, view in runs for one in view.quantities()}
    chosen = _chosen(known, models, wanted)
    packages: list[Subject] = []
    repositories: list[Subject] = []
    broken: list[Broken] = []
    for name, view in runs:
        repositories += [Subject(one.path, one.path, "", name, values=one.values) for one in view.process]
        for summary in view.packages():
            if summary.id == OUTSIDE_PACKAGES:
                continue
            values = {one.key: summary.values[one.key] for one in chosen if one.key in summary.values}
            role = role_of(view, summary)
            packages.append(Subject(summary.id, summary.repository, role, name, language_of(summary), values))
            broken.extend(_broken(summary, role))
    if not any(one.values for one in packages):
        raise UsageError("no package with a value", expected="packages with source", advice="Check other folders")
    measured = {key for one in packages for key in one.values}
    reported = {key for one in repositories for key in one.values}
    columns = tuple(column_of(one, models) for one in chosen if one.key in measured - reported)
    process = (known[key] for key in known if key in reported and (not wanted or key in wanted))
    return Corpus(
        KIND,
        tuple(name for name, _ in runs),
        (*columns, *(msgspec.structs.replace(column_of(one), of=REPOSITORY) for one in process)),
        tuple(packages),
        tuple(repositories),
        tuple(broken),
        size_among(measured),
    )


def _chosen(known: dict[str, Quantity], models: Iterable[QualityModel], wanted: Sequence[str]) -> list[Quantity]:
    if unknown := [key for key in wanted if key not in known]:
        raise UsageError(
            f'no quantity "{unknown[0]}" in these runs',
            expected="keys of quantities",
            advice="`roslens explain` and the page of metrics name them",
        )
    bound = [constraint.quantity for model in models for constraint in model.constraints]
    keys = wanted or [key for key in (*_SIZES, *bound) if key in known]
    return [known[key] for key in dict.fromkeys(keys)]


def language_of(summary: PackageSummary) -> str:
    """Return what most source of a package is written in; nothing where it has none."""
    counted = {
        "cpp": summary.languages.get("cpp", 0) + summary.languages.get("c", 0),
        "python": summary.languages.get("python", 0),
    }
    most = max(counted, key=lambda one: (counted[one], one))
    return most if counted[most] else ""


def _broken(summary: PackageSummary, role: str) -> Iterable[Broken]:
    for rule in summary.rules:
        kind = "metric" if "metrics" in rule.tags else "coding"
        yield Broken(rule.rule, summary.id, role, rule.gated or rule.count, kind)
