"""One finding, many witnesses: what several rules report of one place, by rules that look for the same.

Which rules do is data, ``equivalent.toml``: rows of ids, the one whose finding stands first.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files as packaged
from typing import Literal

import msgspec

from roslens.model.finding import Finding


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
def _row_of_rules() -> Mapping[str, tuple[int, int]]:
    """Return, for each rule that is in a row, the row's number and how early the rule comes in it."""
    return {rule: (number, rank) for number, row in enumerate(equivalents()) for rank, rule in enumerate(row.rules)}


def joined(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings, those that several rules report alike as one that names the others as its witnesses.

    The first finding of one rule at a place is the same as the first of another, the second as the second. The order of
    those that stay is kept.
    """
    all_of_them = tuple(findings)
    row_of = _row_of_rules()
    groups: dict[tuple[int, str, int], dict[int, list[int]]] = {}
    for index, finding in enumerate(all_of_them):
        if finding.path and finding.rule in row_of:
            number, rank = row_of[finding.rule]
            line = finding.line if equivalents()[number].place == "line" else 0
            groups.setdefault((number, finding.path, line), {}).setdefault(rank, []).append(index)
    witnesses: dict[int, tuple[str, ...]] = {}
    gone: set[int] = set()
    for (number, _, _), by_rank in groups.items():
        if len(by_rank) > 1:
            _join(equivalents()[number].rules, by_rank, all_of_them, witnesses, gone)
    return tuple(
        msgspec.structs.replace(finding, witnesses=(*finding.witnesses, *witnesses[index]))
        if index in witnesses
        else finding
        for index, finding in enumerate(all_of_them)
        if index not in gone
    )


def _join(
    rules: Sequence[str],
    by_rank: Mapping[int, list[int]],
    findings: Sequence[Finding],
    witnesses: dict[int, tuple[str, ...]],
    gone: set[int],
) -> None:
    """Join the findings of one place, of each rule the first with the first, the second with the second."""
    ordered = {
        rank: sorted(indexes, key=lambda index: (findings[index].line, findings[index].column))
        for rank, indexes in sorted(by_rank.items())
    }
    for turn in range(max(map(len, ordered.values()))):
        here = [(rank, indexes[turn]) for rank, indexes in ordered.items() if turn < len(indexes)]
        (_, first), *others = here
        if others:
            witnesses[first] = tuple(rules[rank] for rank, _ in others)
            gone.update(index for _, index in others)
