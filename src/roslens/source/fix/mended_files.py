"""Findings mended in memory, turn by turn, until nothing is left that an edit mends.

An edit may make room for another one: two that overlap are made one after the other, each for the content that the
one before left. What results is parsed again, and an edit that brings a place that does not parse is not made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import Location, Role, SourceFile
from roslens.source.fix.chosen_fixes import chosen_fixes
from roslens.source.fix.edited_content import EditError, edited
from roslens.source.fix.still_parses import new_fault
from roslens.source.keys import content_hash
from roslens.source.settings import MacroSettings

MOST_TURNS = 10
"""After these something mends what something else brings, again and again."""

MENDED_ROLES = frozenset({Role.OWN, Role.TEST})
"""Roles of the files that are changed: what others wrote or a program made is none of the team's to mend."""

Again = Callable[[Mapping[str, bytes]], Iterable[Finding]]
"""Returns what is found in the packages of files that have the given contents, by path."""


class MendedFile(msgspec.Struct, frozen=True):
    """A file before and after its findings were mended; ``path`` is below the workspace."""

    path: str
    before: bytes
    after: bytes


class Left(msgspec.Struct, frozen=True):
    """A finding that has a fix and was not mended, and why."""

    finding: Finding
    why: str


class Mended(msgspec.Struct, frozen=True):
    """What became of the findings that have a fix; ``failures`` are those of the edits that could not be made."""

    files: tuple[MendedFile, ...] = ()
    fixed: tuple[Finding, ...] = ()
    left: tuple[Left, ...] = ()
    failures: tuple[Failure, ...] = ()


def mended(
    findings: Iterable[Finding], files: Mapping[str, SourceFile], root: Path, macros: MacroSettings, again: Again
) -> Mended:
    """Mend findings in memory; nothing is written.

    Args:
        findings: of a run, those that are to be mended; what has no edits is passed over.
        files: of the run, by path.
        root: of the workspace.
        macros: of the run, for the parse.
        again: looks at the result, for what another turn can mend.
    """
    mender = _Mender(files, root, macros)
    waiting = [one for one in findings if one.edits]
    for _ in range(MOST_TURNS):
        if not mender.turn(waiting):
            break
        waiting = [one for one in again(mender.texts) if one.edits and not mender.came_back(one)]
    return mender.result()


class _Mender:
    def __init__(self, files: Mapping[str, SourceFile], root: Path, macros: MacroSettings) -> None:
        self._files = files
        self._root = root.resolve()
        self._macros = macros
        self._before: dict[str, bytes] = {}
        self.texts: dict[str, bytes] = {}
        self._fixed: list[Finding] = []
        self._left: dict[tuple[str, str, str], Left] = {}
        self._failures: dict[tuple[str, str], Failure] = {}
        self._refused: dict[str, str] = {}
        self._settled: set[tuple[str, str, str]] = set()

    def turn(self, findings: Sequence[Finding]) -> bool:
        """Make the edits of findings that do not overlap; return whether any was made."""
        able = [one for one in findings if self._may(one)]
        chosen = chosen_fixes(able)
        made = list(chosen.made)
        while made:
            texts = self._edited(made)
            broken = self._broken(made, texts)
            if not broken:
                self.texts.update(texts)
                break
            made = [one for one in made if id(one) not in broken]
        overlapping = {_key(one) for one in chosen.overlapping}
        for one in made:
            self._left.pop(_key(one), None)
            if _key(one) not in overlapping:
                self._settled.add(_key(one))
        for one in chosen.overlapping:
            self._left.setdefault(_key(one), Left(one, "another fix changes the same place"))
        self._fixed += made
        return bool(made)

    def came_back(self, finding: Finding) -> bool:
        """Return whether a finding is as it was, although its edits were made."""
        return _key(finding) in self._settled

    def result(self) -> Mended:
        changed = tuple(
            MendedFile(path, self._before[path], text)
            for path, text in sorted(self.texts.items())
            if text != self._before[path]
        )
        return Mended(changed, tuple(self._fixed), tuple(self._left.values()), tuple(self._failures.values()))

    def _may(self, finding: Finding) -> bool:
        """Return whether all files of the edits of a finding can be edited; if not, report why."""
        for edit in finding.edits:
            why = self._why_not(edit.path, edit.made_for)
            if why:
                self._left.setdefault(_key(finding), Left(finding, why))
                return False
        return True

    def _why_not(self, path: str, made_for: str) -> str:
        if path in self._refused:
            return self._refused[path]
        file = self._files.get(path)
        if file is None or file.role not in MENDED_ROLES:
            return "its file is vendored or generated"
        if path not in self.texts:
            why = self._read(path)
            if why:
                self._refused[path] = why
                return why
        if content_hash(self.texts[path]) != made_for:
            why = self._refused[path] = "its file changed since it was looked at"
            self._fail(path, why, "the file as it was", "Run the same command again")
            return why
        return ""

    def _read(self, path: str) -> str:
        place = (self._root / path).resolve()
        if not place.is_relative_to(self._root):
            return "its file is a link that leads out of the workspace"
        try:
            self._before[path] = self.texts[path] = read_bounded(place)
        except OSError as error:
            why = f"its file cannot be read, {error.strerror}"
            self._fail(path, why, "a file that can be read", "Check its permissions")
            return why
        return ""

    def _edited(self, made: Sequence[Finding]) -> dict[str, bytes]:
        """Return the contents with all edits; of a file whose edits cannot be made what they were."""
        chosen = chosen_fixes(made)
        texts: dict[str, bytes] = {}
        for path in chosen.paths:
            try:
                texts[path] = edited(self.texts[path], chosen.edits(path))
            except EditError as error:
                self._refused[path] = str(error)
                self._fail(path, f"a fix cannot be written: {error}", "a file in UTF-8", "Fix it by hand")
        return texts

    def _broken(self, made: Sequence[Finding], texts: Mapping[str, bytes]) -> set[int]:
        """Return the ids of the objects of findings whose edits bring a place that does not parse, or are refused."""
        broken: set[int] = set()
        for path in dict.fromkeys(edit.path for one in made for edit in one.edits):
            concerned = [one for one in made if any(edit.path == path for edit in one.edits)]
            if path not in texts:
                broken |= self._leave(concerned, self._refused[path])
                continue
            fault = new_fault(self._files[path], self.texts[path], texts[path], self._macros)
            if not fault:
                continue
            guilty = [one for one in concerned if self._alone(one, path)] or concerned
            broken |= self._leave(guilty, "the file would not parse any more")
            rules = ", ".join(sorted({one.rule for one in guilty}))
            what = f"the fix of {rules} would bring a place that does not parse, {fault}; it was not made"
            self._fail(path, what, "a file that parses as before", "Please report it with the file: fix it by hand")
        return broken

    def _alone(self, finding: Finding, path: str) -> str:
        try:
            text = edited(self.texts[path], (edit for edit in finding.edits if edit.path == path))
        except EditError as error:
            return str(error)
        return new_fault(self._files[path], self.texts[path], text, self._macros)

    def _leave(self, findings: Iterable[Finding], why: str) -> set[int]:
        gone = set()
        for one in findings:
            self._left[_key(one)] = Left(one, why)
            self._settled.add(_key(one))
            gone.add(id(one))
        return gone

    def _fail(self, path: str, what: str, expected: str, advice: str) -> None:
        self._failures.setdefault(
            (path, what), Failure("fix", what, expected, advice, Location(path), entity=f"file:{path}")
        )


def _key(finding: Finding) -> tuple[str, str, str]:
    return (finding.rule, finding.path, f"{finding.fingerprint} {finding.message}")
