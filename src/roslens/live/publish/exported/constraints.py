"""The constraints of a reference as monitoring programs need them: what is judged, its range, and how it is shown."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.merge_references import constraints_of

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.judge.reference.reference_document import ReferenceConstraint

ALARMS = ("low", "high", "absent")
"""States that cause a notification."""


def by_group(reference: Reference) -> Iterator[tuple[str, list[ReferenceConstraint]]]:
    """Yield the groups under which operators see constraints, by name, with their constraints; without one first."""
    groups: dict[str, list[ReferenceConstraint]] = {}
    for one in constraints_of(reference):
        groups.setdefault(one.details.group, []).append(one)
    yield from sorted(groups.items())


def words_of(constraint: ReferenceConstraint) -> str:
    """Return a constraint in words: ``topic /scan: rate 25 Hz ± 15 %``."""
    return f"{subject_words(constraint)}: {expected_words(constraint)}"


def quoted(text: str) -> str:
    """Return a text as PromQL writes one."""
    return '"' + text.replace("\\", r"\\").replace('"', r"\"").replace("\n", r"\n") + '"'


def of_reference(reference: Reference) -> str:
    """Return the matcher of what a reference and those that it includes say: their ids begin with their names."""
    names = sorted({one.details.id.partition(".")[0] for one in constraints_of(reference)} | {reference.name})
    joined = "|".join(names)
    return f"expectation=~{quoted(f'(?:{joined})[.].+')}"
