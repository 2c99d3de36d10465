"""The seam: what a plug-in declares and which hooks it may have. The page a plug-in writer reads.

A plug-in is an object (a module or an instance) with an attribute ``manifest`` and at least one hook::

    from roslens.plugins.points import FileInput, Manifest, Report

    manifest = Manifest(name="mine", interface="1.0", version="1.0", scopes=("file",), languages=("cpp",), rules=(…,))

    def analyse_file(file: FileInput, report: Report) -> None:
        if b"goto" in file.content:
            report.finding("mine.goto", "a goto", line=1)

It is found through the entry-point group ``roslens.plugins`` or by a path in ``roslens.toml``
(``plugins = ["./checks/mine.py"]``).
"""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

import msgspec

from roslens.model.entity import Entity
from roslens.model.finding import RuleInfo
from roslens.model.quantity import Quantity
from roslens.model.source import Language, Package, Role

INTERFACE_VERSION = "1.0"
"""Version of this page. A plug-in states the version it was written for; the same major number fits."""

ENTRY_POINT_GROUP = "roslens.plugins"


class Option(msgspec.Struct, frozen=True, omit_defaults=True):
    """An option of a plug-in, set below ``[options.<plug-in>]`` in ``roslens.toml``.

    ``type`` is one of str, int, float, bool, list; ``list`` holds texts.
    """

    name: str
    type: str
    text: str
    default: Any = None


class Manifest(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a plug-in is, needs and gives; read before any of its hooks runs.

    Attributes:
        name: unique, lower case, letters digits and ``_``.
        interface: the version of this page it was written for.
        version: of the plug-in; part of the key of cached results.
        scopes: any of file, package, repository, workspace, configuration; a hook for each.
        languages: values of :class:`~roslens.model.source.Language`; empty means every file.
        needs: quantities (their keys) that other plug-ins give and that must be measured first,
            programs as ``program:NAME``, or plug-ins as ``plugin:NAME``.
        quantities: what it measures; keys are prefixed by ``name.`` (built-ins are exempt).
        rules: what it can find; ids are prefixed by ``name.``.
        options: what users may set.
    """

    name: str
    interface: str
    version: str
    text: str = ""
    scopes: tuple[str, ...] = ("file",)
    languages: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    quantities: tuple[Quantity, ...] = ()
    rules: tuple[RuleInfo, ...] = ()
    options: tuple[Option, ...] = ()


class FileInput(msgspec.Struct, frozen=True):
    """A file as a hook sees it. ``path`` is below the workspace root, ``absolute`` opens it."""

    path: str
    absolute: str
    language: Language
    role: Role
    package: str
    content: bytes
    options: dict[str, Any] = {}


class PackageInput(msgspec.Struct, frozen=True):
    """A package as a hook sees it: its manifest, folder, files and what was measured before.

    ``files`` have empty ``content``: read the ones you need through ``absolute``.
    """

    package: Package
    folder: str
    files: tuple[FileInput, ...]
    entities: tuple[Entity, ...] = ()
    options: dict[str, Any] = {}


class WorkspaceInput(msgspec.Struct, frozen=True):
    """All packages; also given to ``repository`` hooks with the packages of one repository."""

    root: str
    packages: tuple[PackageInput, ...]
    repository: str = ""
    options: dict[str, Any] = {}


@runtime_checkable
class Report(Protocol):
    """Where a hook puts what it sees. Unknown ids and wrong entities become failures of the plug-in."""

    def finding(
        self,
        rule: str,
        message: str,
        *,
        path: str = "",
        line: int = 0,
        column: int = 0,
        end_line: int = 0,
        end_column: int = 0,
        entity: str = "",
        context: str = "",
    ) -> None:
        """Report one occurrence of ``rule``; ``path`` defaults to the file analysed.

        ``context`` is the flagged source text; it makes the fingerprint survive line moves.
        """

    def measurement(self, quantity: str, value: float, *, entity: str = "") -> None:
        """Report a value; ``entity`` (the text form of an id) defaults to the file or package analysed."""

    def failure(self, what: str, *, expected: str = "", advice: str = "", line: int = 0) -> None:
        """Report what could not be analysed; what was reported before stays."""


HOOKS = {
    "file": "analyse_file",
    "package": "analyse_package",
    "repository": "analyse_repository",
    "workspace": "analyse_workspace",
    "configuration": "analyse_configuration",
}
"""Scope to name of the hook; each takes its input and a :class:`Report` and returns nothing."""
