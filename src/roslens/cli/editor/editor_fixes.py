"""Fixes as an editor makes them: changes of open documents and of other files, by lines and columns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.edit import Edit
from roslens.model.finding import Finding
from roslens.model.source import SourceFile
from roslens.source.fix.chosen_fixes import chosen_fixes
from roslens.source.fix.edited_content import EditError, edited
from roslens.source.fix.mended_files import MENDED_ROLES
from roslens.source.fix.still_parses import new_fault
from roslens.source.keys import content_hash
from roslens.source.settings import MacroSettings


class EditorFix(msgspec.Struct, frozen=True):
    """What an action does: a title, and the edits of each file by its path, their texts with its line ends."""

    title: str
    edits: Mapping[str, tuple[Edit, ...]]


class FixableFolder:
    """Makes fixes of findings in a folder.

    ``files`` are those of its packages by path; ``macros`` are for the parse.
    """

    def __init__(self, root: Path, files: Mapping[str, SourceFile], macros: MacroSettings) -> None:
        """``root`` is that of the folder."""
        self._root = root
        self._files = files
        self._macros = macros

    def fix_of(self, finding: Finding, path: str, document: bytes) -> EditorFix | None:
        """Return what mends one finding; None where it has no fix, or it was found in another content.

        Args:
            finding: in a document.
            path: of the document.
            document: as the editor has it.
        """
        made = self._made([finding], path, document)
        return EditorFix(f"Fix {finding.rule}: {finding.message}", made) if made else None

    def fix_of_all(self, findings: Iterable[Finding], path: str, document: bytes) -> EditorFix | None:
        """Return what mends all findings of a document whose edits are in it alone; None where there is nothing."""
        here = [one for one in findings if one.gated and all(edit.path == path for edit in one.edits)]
        made = self._made(here, path, document)
        return EditorFix("Fix all that roslens can fix safely", made) if made else None

    def _made(self, findings: Sequence[Finding], path: str, document: bytes) -> dict[str, tuple[Edit, ...]]:
        chosen = chosen_fixes(one for one in findings if one.edits)
        made: dict[str, tuple[Edit, ...]] = {}
        for target in chosen.paths:
            file = self._files.get(target)
            content = document if target == path else self._content(target)
            edits = chosen.edits(target)
            if file is None or content is None or file.role not in MENDED_ROLES:
                return {}
            if any(edit.made_for != content_hash(content) for edit in edits):
                return {}
            try:
                if new_fault(file, content, edited(content, edits), self._macros):
                    return {}
            except EditError:
                return {}
            made[target] = tuple(_with_line_ends(edit, content) for edit in edits)
        return made

    def _content(self, path: str) -> bytes | None:
        try:
            return read_bounded(self._root / path)
        except OSError:
            return None


def _with_line_ends(edit: Edit, content: bytes) -> Edit:
    if b"\r\n" not in content:
        return edit
    return msgspec.structs.replace(edit, text=edit.text.replace("\r\n", "\n").replace("\n", "\r\n"))
