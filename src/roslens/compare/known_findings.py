"""Which findings of a run an earlier one had: by fingerprint, and by message where code or files moved."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import PurePosixPath

import msgspec

from roslens.model.finding import Finding
from roslens.model.same_finding import Key, key_of_finding, said, within_file


class SinceBaseline(msgspec.Struct, frozen=True):
    """What is different from a baseline: keys of new findings, and how many are gone."""

    new: frozenset[Key]
    gone: int


def since_baseline(
    before: Sequence[Finding],
    after: Iterable[Finding],
    files: Collection[str],
    renamed: Mapping[str, str] | None = None,
) -> SinceBaseline:
    """Return which findings are new.

    A finding is known when the baseline has its fingerprint. Otherwise it may be one of those whose fingerprint is
    gone: of the same rule, entity and message (whatever numbers stand in it), and in a function or class of the same
    name, or in a file that was renamed to this one or is gone and had the same name. Each of these is one finding now
    at most.

    Args:
        before: findings of the baseline.
        after: findings of the run.
        files: paths of all files of the run.
        renamed: paths of files now by those in the baseline, as far as that is known.
    """
    now = list(after)
    there = {one.fingerprint for one in now}
    known = {one.fingerprint for one in before if one.fingerprint}
    waiting: dict[tuple[str, str, str], list[Finding]] = defaultdict(list)
    gone = [one for one in before if one.fingerprint not in there]
    for one in gone:
        waiting[_essence(one)].append(one)
    new, found_again = set(), 0
    for one in now:
        if one.fingerprint in known:
            continue
        candidates = waiting.get(_essence(one), [])
        place = next((at for at, other in enumerate(candidates) if _may_be(other, one, files, renamed or {})), None)
        if place is None:
            new.add(key_of_finding(one))
        else:
            candidates.pop(place)
            found_again += 1
    return SinceBaseline(frozenset(new), len(gone) - found_again)


def _essence(finding: Finding) -> tuple[str, str, str]:
    return finding.rule, within_file(finding.entity), said(finding.message, finding.path)


def _may_be(before: Finding, after: Finding, files: Collection[str], renamed: Mapping[str, str]) -> bool:
    if renamed.get(before.path) == after.path or before.path == after.path:
        return True
    if "#" in before.entity:
        return True
    return before.path not in files and PurePosixPath(before.path).name == PurePosixPath(after.path).name
