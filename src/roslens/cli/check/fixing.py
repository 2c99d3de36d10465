"""Findings of a run mended, for ``roslens check``: in memory, shown as a diff, or written."""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.check.analysed import settings_of
from roslens.cli.workplace.workplace import CACHE, own_folder
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.source.fix.last_fix import FILE_NAME, LastFix, keep_last_fix, take_back
from roslens.source.fix.mended_files import Left, Mended, mended
from roslens.source.fix.write_files import write_files
from roslens.source.tools.running.tool_edits import with_tool_edits

if TYPE_CHECKING:
    from roslens.cli.check.check_scope import Scope
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.source import SourceFile

MOST_REASONS = 4
"""Reasons for what is left that the summary names."""


def is_asked_for(finding: Finding, options: argparse.Namespace) -> bool:
    """Return whether a finding is to be mended, if it has a fix: it counts, and its rule is one that was asked for."""
    if not finding.gated:
        return False
    return not options.fix_rule or any(fnmatchcase(finding.rule, one) for one in options.fix_rule)


def mended_scope(options: argparse.Namespace, root: Path, configuration: Configuration, scope: Scope) -> Mended:
    """Return what becomes of the findings that are shown; nothing is written.

    Raises:
        RoslensError: the workspace cannot be looked at again.
    """
    view, tags = scope.shown, scope.wanted.tags
    files = {file.path: file for _, file in view.files()}
    settings = settings_of(options, configuration, os.environ)
    shown = [one for _, one in view.owned_findings(tags) if is_asked_for(one, options)]
    found, failures = with_tool_edits(shown, files, str(root), settings)
    owned = [one for one in found if one.edits]
    if not owned:
        return Mended(failures=failures)
    packages = {file.path: package for package, file in view.files()}
    looker = _Looker(options, root, configuration, files, packages)
    first = {one.path for one in owned}
    # A finding that another one brought to light is mended where those of the run are: in these files, of these tags.
    narrow = options.changed is not None or options.new_only
    rules = {one.rule for one in owned}

    def again(texts: Mapping[str, bytes]) -> Iterator[Finding]:
        for one in looker.look(texts):
            if is_asked_for(one, options) and tags.matches(one.tags) and (not narrow or _is_near(one, first, rules)):
                yield one

    result = mended(owned, files, root, settings.macros, again)
    return msgspec.structs.replace(result, failures=(*failures, *result.failures))


def _is_near(finding: Finding, paths: set[str], rules: set[str]) -> bool:
    return finding.path in paths and finding.rule in rules


class _Looker:
    """Looks again at packages whose files have other contents."""

    def __init__(
        self,
        options: argparse.Namespace,
        root: Path,
        configuration: Configuration,
        files: Mapping[str, SourceFile],
        packages: Mapping[str, str],
    ) -> None:
        self._options = options
        self._root = root
        self._configuration = configuration
        self._files = files
        self._packages = packages

    def look(self, texts: Mapping[str, bytes]) -> Iterator[Finding]:
        from roslens.source.keys import content_hash
        from roslens.source.measure.fresh_package import FreshPackages
        from roslens.store.cache import Cache

        changed = {path: text for path, text in texts.items() if content_hash(text) != self._files[path].content_hash}
        settings = settings_of(self._options, self._configuration, os.environ)
        kept = None if self._options.no_cache else own_folder(self._root) / CACHE
        with Cache.open(kept) as cache:
            fresh = FreshPackages(self._options.paths, settings, Path(self._configuration.base or "."), cache)
            for package in sorted({self._packages[path] for path in changed}):
                yield from fresh.judged(package, changed).findings


def written(result: Mended, root: Path, *, keep: bool, earlier: LastFix | None = None) -> tuple[Mended, LastFix | None]:
    """Write what was mended; return what of it is written, and what takes all of it back.

    Args:
        result: in memory.
        root: of the workspace.
        keep: whether the way back is kept.
        earlier: what this command wrote before.

    Raises:
        UsageError: the way back cannot be kept; then nothing is written.
    """
    if not result.files:
        return result, earlier
    record = earlier
    if keep:
        place = own_folder(root) / FILE_NAME
        try:
            record = keep_last_fix(result.files, place, earlier)
        except OSError as error:
            raise UsageError(
                f"nothing is fixed: the way back cannot be kept, {error.strerror}",
                where=str(place),
                expected="a folder that can be written",
                advice="Make room, or give --no-store to fix without a way back",
            ) from error
    files, faults = write_files(result.files, root)
    lost = {fault.file.path: fault.failure for fault in faults}
    fixed = tuple(one for one in result.fixed if not any(edit.path in lost for edit in one.edits))
    left = tuple(
        Left(one, next(f"its file: {lost[edit.path].what}" for edit in one.edits if edit.path in lost))
        for one in result.fixed
        if any(edit.path in lost for edit in one.edits)
    )
    failures = (*result.failures, *lost.values())
    return msgspec.structs.replace(
        result, files=files, fixed=fixed, left=(*result.left, *left), failures=failures
    ), record


def summary(results: Sequence[Mended], *, would: bool = False) -> str:
    """Return a line on what was fixed, and why what the last of several rounds left was not."""
    fixed = [one for result in results for one in result.fixed]
    left = results[-1].left
    files = {file.path for result in results for file in result.files}
    count = len(fixed) + len(left)
    if not count:
        return "nothing to fix: no finding that is shown has a safe fix"
    verb = "would fix" if would else "fixed"
    text = f"{verb} {len(fixed)} of {_number(count, 'finding')} with a fix in {_number(len(files), 'file')}"
    if not left:
        return text
    reasons = Counter(one.why for one in left).most_common()
    reported = [f"{number} because {why}" for why, number in reasons[:MOST_REASONS]]
    if len(reasons) > MOST_REASONS:
        reported.append(f"{sum(number for _, number in reasons[MOST_REASONS:])} for other reasons")
    return f"{text}; {len(left)} not: {', '.join(reported)}"


def _number(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def undo(root: Path) -> tuple[tuple[str, ...], tuple[Failure, ...]]:
    """Take the last fix back; return the files that are as they were, and what could not be taken back.

    Raises:
        UsageError: there is none.
    """
    done, faults = take_back(own_folder(root) / FILE_NAME, root)
    return done, tuple(fault.failure for fault in faults)
