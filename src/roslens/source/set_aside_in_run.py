"""What of a whole run is set aside: findings that only all packages together show, and what had no effect."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.model.finding import Finding
from roslens.model.set_aside import SetAside
from roslens.source.workspace.acceptances import FILE_NAME as ACCEPTED
from roslens.source.workspace.silence import Silence

Owned = Mapping[str, tuple[Finding, ...]]
"""Findings by the id of their package."""


class Whole(msgspec.Struct, frozen=True):
    """Findings of all packages together that count, by package and of none, and those that do not."""

    owned: dict[str, tuple[Finding, ...]]
    none: tuple[Finding, ...]
    set_aside: tuple[SetAside, ...]


def whole_run(
    silence: Silence,
    owned: Owned,
    none: Sequence[Finding],
    used: Iterable[str],
    *,
    root: Path,
    base: Path,
    judged: Iterable[str],
) -> Whole:
    """Return what counts of the findings of all packages together, with notes on what set nothing aside.

    Args:
        silence: of the workspace.
        owned: findings by package.
        none: findings of no package.
        used: what set findings of single packages aside, as :attr:`SetAside.by` has it.
        root: of the workspace.
        base: folder of the configuration.
        judged: ids of the rules of the run.
    """
    aside: list[SetAside] = []
    kept: dict[str, tuple[Finding, ...]] = {}
    for package, findings in owned.items():
        found = silence.sorted_out(findings, {}, package=package)
        aside += found.set_aside
        if found.kept:
            kept[package] = found.kept
    rest = silence.sorted_out(none, {})
    aside += rest.set_aside
    notes = silence.without_effect(
        {*used, *(one.by for one in aside)},
        _below(root, base / "roslens.toml"),
        _below(root, base / ACCEPTED),
        judged,
    )
    return Whole(kept, (*rest.kept, *notes), tuple(aside))


def _below(root: Path, file: Path) -> str:
    """Return the path of a file below the workspace; empty where it lies outside, or is not there."""
    place = file.resolve()
    return place.relative_to(root).as_posix() if place.is_relative_to(root) and place.is_file() else ""
