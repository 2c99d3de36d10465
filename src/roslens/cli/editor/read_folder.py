"""What a folder that an editor has open is read for: in a process of its own, which a file that breaks it ends alone.

Questions go by path; the process that answers them opens a folder when it is first asked about it, and keeps it.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.editor.editor_fixes import EditorFix, FixableFolder
from roslens.model.finding import Finding, RuleInfo
from roslens.source.engines.watched_reader import LostReaderError, WatchedReader
from roslens.source.measure.fresh_package import Fresh

if TYPE_CHECKING:
    from roslens.source.measure.fresh_package import FreshPackages


class Asked(msgspec.Struct, frozen=True):
    """A folder as it is to be read: its path, and what the user chose; see ``roslens lsp``."""

    root: str
    models: tuple[str, ...] | None = None
    configuration: str | None = None
    keeps_nothing: bool = False


class Folder:
    """A folder that the editor has open.

    Raises:
        RoslensError: its configuration is wrong.
    """

    def __init__(self, root: Path, options: argparse.Namespace) -> None:
        """``options`` are those of ``roslens lsp``."""
        self.root = root.resolve()
        given = options.config and os.path.abspath(options.config)  # noqa: PTH100 - no links followed
        models = None if options.model is None else tuple(options.model)
        self._asked = Asked(str(self.root), models, given, options.no_cache)
        self._reader = WatchedReader(str(self.root))
        self.rules: dict[str, RuleInfo] = self._reader.ask(rules_of, self._asked)

    def path_of(self, file: Path) -> str:
        """Return the path of a file below the folder; empty where it is elsewhere."""
        place = file.resolve()
        return place.relative_to(self.root).as_posix() if place.is_relative_to(self.root) else ""

    def look(self, path: str, *, again: bool) -> Fresh | str | None:
        """Return what is found in a file, a line about why not, or None where it is not of the workspace."""
        try:
            return self._reader.ask(look_at, self._asked, path, again)
        except LostReaderError as error:
            return f"{path}: cannot be looked at: {error}"

    def fixes(self, findings: Sequence[Finding], path: str, document: bytes) -> tuple[EditorFix | None, ...]:
        """Return what fixes each finding of a document, as the editor has it."""
        try:
            return self._reader.ask(fixes_of, self._asked, tuple(findings), path, document)
        except LostReaderError:
            return ()

    def fix_of_all(self, findings: Sequence[Finding], path: str, document: bytes) -> EditorFix | None:
        """Return what fixes all findings of a document whose edits are in it alone."""
        try:
            return self._reader.ask(fix_of_all, self._asked, tuple(findings), path, document)
        except LostReaderError:
            return None

    def end(self) -> None:
        """End the process that reads."""
        self._reader.end()


_opened: dict[Asked, FreshPackages] = {}


def _fresh(asked: Asked) -> FreshPackages:
    if asked in _opened:
        return _opened[asked]
    from roslens.cli.check.analysed import settings_of
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.trust import admitted
    from roslens.cli.workplace.workplace import CACHE, own_folder
    from roslens.source.measure.fresh_package import FreshPackages
    from roslens.store.cache import Cache

    root = Path(asked.root)
    options = argparse.Namespace(model=asked.models, config=asked.configuration, no_cache=asked.keeps_nothing)
    # An editor opens folders of strangers, and there is no one to ask.
    configuration = admitted(find_configuration(root, asked.configuration), given=False, environment=os.environ)
    settings = settings_of(options, configuration, os.environ)
    cache = Cache.open(None if asked.keeps_nothing else own_folder(root) / CACHE)
    _opened[asked] = FreshPackages([root], settings, Path(configuration.base or "."), cache)
    return _opened[asked]


def rules_of(asked: Asked) -> dict[str, RuleInfo]:
    """Return what is known of the rules of a folder, by id.

    Raises:
        RoslensError: its configuration is wrong.
    """
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.explainable import known
    from roslens.cli.workplace.trust import admitted

    _fresh(asked)
    root = Path(asked.root)
    configuration = admitted(find_configuration(root, asked.configuration), given=False, environment=os.environ)
    return known(configuration)[2]


def look_at(asked: Asked, path: str, again: bool) -> Fresh | str | None:
    """Return what is found in a file, a line about why not, or None where it is not of the workspace.

    Args:
        asked: the folder.
        path: of the file below it.
        again: whether it was saved.
    """
    from roslens.cli.check.check_watch import look

    fresh = _fresh(asked)
    if path not in fresh.files or (again and path.endswith("package.xml")):
        fresh.find()
    return look(fresh, path)


def fixes_of(asked: Asked, findings: tuple[Finding, ...], path: str, document: bytes) -> tuple[EditorFix | None, ...]:
    """Return what fixes each finding of a document; nothing where it is not of the workspace."""
    fixable = _fixable(asked, path)
    return tuple(fixable.fix_of(one, path, document) for one in findings) if fixable is not None else ()


def fix_of_all(asked: Asked, findings: tuple[Finding, ...], path: str, document: bytes) -> EditorFix | None:
    """Return what fixes all findings of a document; None where it is not of the workspace, or there is nothing."""
    fixable = _fixable(asked, path)
    return fixable.fix_of_all(findings, path, document) if fixable is not None else None


def _fixable(asked: Asked, path: str) -> FixableFolder | None:
    fresh = _fresh(asked)
    return FixableFolder(Path(asked.root), fresh.by_path, fresh.macros) if path in fresh.files else None
