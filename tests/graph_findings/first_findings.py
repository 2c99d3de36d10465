"""What a maintainer would make of the first findings that the command line shows of some repositories."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec
import yaml

from graph_findings.judgements import ROOT

TABLE = ROOT / "tests" / "fixtures" / "first_findings" / "shown.yaml"


class First(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A row that the command line shows, by its example, and whether it is worth acting on."""

    rule: str
    place: str
    worth: bool
    why: str


class Shown(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A repository.

    Attributes:
        kloc: thousands of lines of code.
        warnings: warnings and errors that count, without any setting.
        findings: the first rows that are shown, ten at most.
    """

    kloc: float
    warnings: int
    findings: list[First]


def read_shown(path: Path = TABLE) -> dict[str, Shown]:
    """Return the table.

    Raises:
        ValidationError: the file is none.
    """
    return msgspec.convert(yaml.safe_load(path.read_text("utf-8")), dict[str, Shown])


def section(shown: dict[str, Shown]) -> Iterator[str]:
    """Yield the lines of the page on them."""
    yield from (
        "## The first findings that are shown",
        "",
        "What `roslens check` shows of some repositories first, ten rows at most, read as maintainers would. A row",
        "is a rule with its worst example; a limit of metrics has one only where it is exceeded sixteen times, all",
        "others are counted in one line. The order was made with the first three; the next three were read once it was",
        "settled. The next eight are named nowhere else: five were read once what changed lately was weighed, three",
        "after the ninth table. The last three were read after the fourteenth. What was not worth acting on there was",
        "mended after, but for a wait that another file hides (cob_driver).",
        "",
    )
    for name, one in shown.items():
        worth = sum(each.worth for each in one.findings)
        rate = one.warnings / one.kloc
        yield f"### {name}: {worth} of {len(one.findings)} worth acting on"
        yield ""
        counted = f"{one.warnings} warnings and errors in {one.kloc} kLOC ({rate:.1f} per kLOC)"
        yield f"{counted}, limits of metrics included."
        yield ""
        for each in one.findings:
            yield f"- {'yes' if each.worth else 'no'}: `{each.rule}`, `{each.place}`: {each.why}"
        yield ""
