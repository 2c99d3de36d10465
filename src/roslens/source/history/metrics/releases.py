"""Number of releases."""

from __future__ import annotations

import re
from collections.abc import Iterable

from roslens.model.entity import EntityKind
from roslens.model.process import Release
from roslens.model.quantity import Better, Quantity

VERSION = re.compile(r"(?:.*[^0-9])?(\d+\.\d+(?:\.\d+)*)(?:[-+.]?(?:rc|alpha|beta|pre|dev|post)?[-.]?\d*)?")
"""A tag that names a version: ``1.2.3``, ``v1.2``, ``robot-1.2.3``, ``release/1.2.3-rc1``."""

QUANTITY = Quantity(
    key="releases",
    title="Releases",
    unit="tags",
    kinds=(EntityKind.REPOSITORY,),
    text="How many versions were released: tags behind the head that name one.",
    better=Better.NEITHER,
    formula="number of tags of commits behind the head whose name ends in a version such as 1.2 or v1.2.3-rc1",
    source="plain count",
    limits="A clone without tags (`--no-tags`, `--single-branch --depth`) has none.",
)

COMMANDS = {
    "repository": r"git tag --merged HEAD | grep -cE '^(.*[^0-9])?[0-9]+\.[0-9]+(\.[0-9]+)*"
    r"([-+.]?(rc|alpha|beta|pre|dev|post)?[-.]?[0-9]*)?$'",
}


def of_releases(releases: Iterable[Release]) -> float:
    """Return how many there are."""
    return len(tuple(releases))


def is_release(tag: str) -> bool:
    """Return whether the name of a tag is that of a version."""
    return VERSION.fullmatch(tag) is not None
