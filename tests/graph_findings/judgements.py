"""Samples of findings and what who read the places says of them: the tables in ``tests/fixtures/*_findings``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from random import Random
from types import MappingProxyType
from typing import Any

import msgspec
import yaml

from roslens.intake.safe_yaml import load_yaml

ROOT = Path(__file__).parents[2]
TABLES = ROOT / "tests" / "fixtures" / "graph_findings"
NATIVE_TABLES = ROOT / "tests" / "fixtures" / "rule_findings"


class Judgement(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A finding that was drawn, and whether it is true.

    Attributes:
        repository: ``owner/name``.
        rule: of the finding.
        severity: of it.
        path: in the repository.
        line: in it.
        entity: that it is about.
        message: of it.
        verdict: True where a maintainer would agree that it is a real problem worth acting on; None is not judged yet.
        why: in words, by who read the place.
    """

    repository: str
    rule: str
    severity: str
    path: str
    line: int
    entity: str
    message: str
    verdict: bool | None = None
    why: str = ""


class Sample(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Findings drawn of what the command line finds in some repositories.

    Attributes:
        developed_on: whether the rules were changed because of what they find there.
        seed: that they were drawn with.
        per_rule: at most so many of each rule.
        severity: that they have at least.
        repositories: commit by name.
        not_read: by name why the command line says nothing.
        population: how many there are, by rule.
        notes: how many notes there are besides, by rule.
        findings: that were drawn.
        per_repository: at most so many of each rule in one repository; 0 is as many as there are.
        whole: whether a rule of which there are at most ``per_rule`` findings was drawn in full, however many are of
            one repository.
        spared: at most so many of these rules, by rule: enough was read of them before.
        only: the rules that it is about; empty is all. Of others it says nothing.
    """

    developed_on: bool
    seed: int
    per_rule: int
    severity: str
    repositories: dict[str, str]
    not_read: dict[str, str]
    population: dict[str, int]
    notes: dict[str, int]
    findings: list[Judgement]
    per_repository: int = 0
    whole: bool = False
    spared: dict[str, int] = {}
    only: list[str] = []

    def looks_at(self, rule: str) -> bool:
        """Return whether it says anything of a rule."""
        return not self.only or rule in self.only


def drawn(
    found: Mapping[str, Sequence[Mapping[str, Any]]],
    seed: int,
    per_rule: int,
    per_repository: int = 0,
    *,
    whole: bool = False,
    spared: Mapping[str, int] = MappingProxyType({}),
) -> list[Judgement]:
    """Return at most ``per_rule`` findings of each rule; the same findings and seed give the same ones.

    Args:
        found: by repository.
        seed: of the choice; each rule has its own, so that a change of one leaves the others as they are.
        per_rule: at most so many.
        per_repository: at most so many of each rule in one repository, so that one with many of a rule does not decide
            alone; 0 is as many as there are.
        whole: draw all of a rule of which there are at most ``per_rule``, so that nothing of it is left to chance.
        spared: at most so many of these rules instead, by rule.
    """
    by_rule: dict[str, list[Judgement]] = {}
    for name, findings in sorted(found.items()):
        for one in findings:
            row = Judgement(
                name, one["rule"], one["severity"], one.get("path", ""), one.get("line", 0), one.get("entity", ""),
                one["message"],
            )  # fmt: skip
            by_rule.setdefault(row.rule, []).append(row)
    chosen = []
    for rule, rows in sorted(by_rule.items()):
        most = spared.get(rule, per_rule)
        if not whole or len(rows) > most:
            rows = _spread(rows, f"{seed} {rule}", per_repository)
        chosen += sorted(Random(f"{seed} {rule}").sample(rows, min(most, len(rows))), key=_order)
    return chosen


def _spread(rows: Sequence[Judgement], seed: str, per_repository: int) -> list[Judgement]:
    """Return the findings of a rule, at most so many of each repository."""
    kept: list[Judgement] = []
    for name in sorted({one.repository for one in rows}):
        every = sorted((one for one in rows if one.repository == name), key=_order)
        most = per_repository or len(every)
        kept += sorted(Random(f"{seed} {name}").sample(every, min(most, len(every))), key=_order)
    return kept


def _order(one: Judgement) -> tuple[str, str, int, str, str]:
    return one.repository, one.path, one.line, one.entity, one.message


def taken_over(findings: Iterable[Judgement], commits: Mapping[str, str], judged: Iterable[Sample]) -> list[Judgement]:
    """Return findings with the verdicts that samples of the same commits have of the same place and entity."""
    known = {
        (sample.repositories[one.repository], *_place(one)): one
        for sample in judged
        for one in sample.findings
        if one.verdict is not None
    }
    rows = []
    for one in findings:
        old = known.get((commits[one.repository], *_place(one)))
        rows.append(one if old is None else msgspec.structs.replace(one, verdict=old.verdict, why=old.why))
    return rows


def _place(one: Judgement) -> tuple[str, str, str, int, str]:
    return one.repository, one.rule, one.path, one.line, one.entity


def read(path: Path) -> Sample:
    """Return a sample.

    Raises:
        ValidationError: the file is none.
    """
    return msgspec.convert(load_yaml(path.read_bytes()), Sample)


def write(sample: Sample, path: Path) -> None:
    """Write a sample, to be judged by hand: ``verdict: true`` or ``false``, and ``why``."""
    path.write_text(
        yaml.safe_dump(msgspec.to_builtins(sample), sort_keys=False, allow_unicode=True, width=120), "utf-8"
    )


def samples(folder: Path = TABLES) -> dict[str, Sample]:
    """Return all samples of the project, by the name of their file."""
    return {path.stem: read(path) for path in sorted(folder.glob("*.yaml"))}
