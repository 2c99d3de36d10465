"""2: how changes come about."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.requirement import Item
from roslens.source.evidence.answer import met, not_known, not_met
from roslens.source.evidence.package_folder import PackageFolder
from roslens.source.evidence.version import declared

LOOKED_AT = 100
"""Changes of the main line that are looked at, the newest."""

_NEARLY_ALL, _FEW = 0.95, 0.5
_REQUEST = re.compile(r"\(#\d+\)|\(!\d+\)|^Merge (pull request|branch|remote)|See merge request")


class Change(msgspec.Struct, frozen=True):
    """A commit of the main line: its subject, how many parents it has, whether somebody signed it off."""

    subject: str
    parents: int
    signed: bool


def changes(folder: PackageFolder, log: Sequence[Change] | None) -> Iterator[Item]:
    """Yield what is known of changes; ``log`` is None where there is no history."""
    yield _requests(log)
    yield _origin(folder, log)
    yield not_known("2.iii", "reviews are known to the forge, not to the source")
    yield _integration(folder)
    yield declared(folder, "2.v", r"documentation policy|change control.*documentation", "documentation of changes")


def _requests(log: Sequence[Change] | None) -> Item:
    if not log:
        return not_known("2.i", "no history that could be read")
    through = sum(one.parents > 1 or bool(_REQUEST.search(one.subject)) for one in log)
    shown = f"{through} of the last {len(log)} changes of the main line name or merge a change request"
    if through >= _NEARLY_ALL * len(log):
        return met("2.i", shown)
    return not_met("2.i", shown) if through < _FEW * len(log) else not_known("2.i", shown)


def _origin(folder: PackageFolder, log: Sequence[Change] | None) -> Item:
    contributing = folder.find("CONTRIBUTING.md", "CONTRIBUTING.rst")
    place = folder.says(
        r"developer certificate of origin|\bDCO\b|contributor license agreement|\bCLA\b|signed-off-by", contributing
    )
    signed = sum(one.signed for one in log or ())
    if log and signed >= _NEARLY_ALL * len(log):
        return met("2.ii", f"{signed} of the last {len(log)} changes are signed off", place)
    if place:
        return met("2.ii", "contributors are required to", place)
    if not log:
        return not_known("2.ii", "no history that could be read, and no CONTRIBUTING that requires it")
    return not_met("2.ii", f"{signed} of the last {len(log)} changes are signed off, and no CONTRIBUTING requires it")


def _integration(folder: PackageFolder) -> Item:
    if not folder.pipelines:
        return not_known("2.iv", "no pipeline in the repository; the ROS build farm may run one")
    for path in folder.pipelines:
        if place := folder.says(r"\bpull_request\b|merge_request", path):
            return met("2.iv", f"{len(folder.pipelines)} pipelines, one of them on change requests", place)
    places = (folder.location(one) for one in folder.pipelines)
    return not_known("2.iv", f"{len(folder.pipelines)} pipelines, none of them triggered by change requests", *places)
