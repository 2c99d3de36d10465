"""One finding, many witnesses: what several rules report of one place, by rules that look for the same.

Which rules do is data: the rows of ``equivalent.toml``, the rule whose finding stands first, and the checks of tools
that native rules name among their clauses.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files as packaged
from typing import Literal

import msgspec

from roslens.model.edit import Edit
from roslens.model.finding import Finding
from roslens.source.tools.checks.tool_checks import checks_of, rule_id
from roslens.source.tools.used import TOOLS, plain


class Equivalent(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """Rules that look for the same.

    Attributes:
        about: what they look for.
        rules: their ids, most telling first: that of roslens' own rule, where there is one.
        place: what two findings must share to be one, their ``line`` or their ``file``.
    """

    about: str
    rules: tuple[str, ...]
    place: Literal["line", "file"] = "line"


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    same: tuple[Equivalent, ...]


@cache
def equivalents() -> tuple[Equivalent, ...]:
    """Return the rows of the data file."""
    import tomli

    text = packaged("roslens.source.tools").joinpath("equivalent.toml").read_text("utf-8")
    return msgspec.convert(tomli.loads(text), _Document).same


@cache
def all_equivalents() -> tuple[Equivalent, ...]:
    """Return the rows of the data file, then one for each other native rule that names checks of tools as clauses."""
    from roslens.source.rules.table import native_rules

    reported = {rule for row in equivalents() for rule in row.rules}
    rows = [
        Equivalent(rule.title, (rule.id, *peers))
        for rule in native_rules().values()
        if rule.id not in reported and (peers := tuple(dict.fromkeys(_peers(rule.clauses))))
    ]
    return (*equivalents(), *rows)


def _peers(clauses: Iterable[str]) -> Iterator[str]:
    """Yield the ids of the checks of tools among clauses: ``clang-tidy bugprone-x`` is ``clang_tidy.bugprone-x``."""
    for clause in clauses:
        tool, _, check = clause.partition(" ")
        name = plain(tool)
        if check and name in TOOLS:
            yield rule_id(name, checks_of(name).names.get(check, check))


def joined(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings, those that several rules report alike as one that names the others as its witnesses.

    The first finding of one rule at a place is the same as the first of another, the second as the second. The order
    of those that stay is kept.
    """
    all_of_them = tuple(findings)
    by_rule: dict[str, list[int]] = {}
    for index, finding in enumerate(all_of_them):
        if finding.path:
            by_rule.setdefault(finding.rule, []).append(index)
    if not any(rule.partition(".")[0] in TOOLS for rule in by_rule):
        return all_of_them
    witnesses: dict[int, tuple[str, ...]] = {}
    edits: dict[int, tuple[Edit, ...]] = {}
    gone: set[int] = set()
    for row in all_equivalents():
        present = [rule for rule in row.rules if rule in by_rule]
        if len(present) > 1:
            for by_rank in _places(row, present, by_rule, all_of_them, gone):
                for first, others in _join(present, by_rank, all_of_them, witnesses, gone):
                    edits[first] = next((one.edits for one in others if one.edits), edits.get(first, ()))
    return tuple(
        _with(finding, witnesses.get(index), edits.get(index, ()))
        for index, finding in enumerate(all_of_them)
        if index not in gone
    )


def _with(finding: Finding, witnesses: tuple[str, ...] | None, edits: tuple[Edit, ...]) -> Finding:
    if witnesses is None:
        return finding
    return msgspec.structs.replace(finding, witnesses=(*finding.witnesses, *witnesses), edits=finding.edits or edits)


def _places(
    row: Equivalent,
    present: Sequence[str],
    by_rule: Mapping[str, list[int]],
    findings: Sequence[Finding],
    gone: Collection[int],
) -> Iterator[Mapping[int, list[int]]]:
    """Yield, for each place where two or more rules of a row report something, their findings by rank."""
    places: dict[tuple[str, int], dict[int, list[int]]] = {}
    for rank, rule in enumerate(present):
        for index in by_rule[rule]:
            if index not in gone:
                finding = findings[index]
                place = (finding.path, finding.line if row.place == "line" else 0)
                places.setdefault(place, {}).setdefault(rank, []).append(index)
    yield from (by_rank for by_rank in places.values() if len(by_rank) > 1)


def _join(
    rules: Sequence[str],
    by_rank: Mapping[int, list[int]],
    findings: Sequence[Finding],
    witnesses: dict[int, tuple[str, ...]],
    gone: set[int],
) -> Iterator[tuple[int, tuple[Finding, ...]]]:
    """Join the findings of one place, of each rule the first with the first, the second with the second.

    Yields each that stays with those that it stands for.
    """
    ordered = {
        rank: sorted(indexes, key=lambda index: (findings[index].line, findings[index].column))
        for rank, indexes in sorted(by_rank.items())
    }
    for turn in range(max(map(len, ordered.values()))):
        here = [(rank, indexes[turn]) for rank, indexes in ordered.items() if turn < len(indexes)]
        (_, first), *others = here
        if others:
            reported = [rule for rank, index in others for rule in (rules[rank], *witnesses.get(index, ()))]
            witnesses[first] = (*witnesses.get(first, ()), *reported)
            gone.update(index for _, index in others)
            yield first, tuple(findings[index] for _, index in others)
