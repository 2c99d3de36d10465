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

from collections.abc import Callable
from typing import Any, Protocol, runtime_checkable

import msgspec

from roslens.model.entity import Entity
from roslens.model.finding import Finding, RuleInfo
from roslens.model.quantity import Measurement, Quantity
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
        scopes: any of file, package, repository, workspace, results, configuration; a hook for each.
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
    """A file as a hook sees it. ``path`` is below the workspace root, ``absolute`` opens it.

    ``entities`` are the file's classes and functions as far as they are known.
    """

    path: str
    absolute: str
    language: Language
    role: Role
    package: str
    content: bytes
    options: dict[str, Any] = {}
    entities: tuple[Entity, ...] = ()


class PackageInput(msgspec.Struct, frozen=True):
    """A package as a hook sees it: its manifest, folder, files and what was measured before.

    ``folder`` is absolute. ``files`` have empty ``content``: read the ones you need through
    ``absolute``. ``entities`` hold what was measured before, also by the plug-ins this one needs.
    """

    package: Package
    folder: str
    files: tuple[FileInput, ...]
    entities: tuple[Entity, ...] = ()
    options: dict[str, Any] = {}


class WorkspaceInput(msgspec.Struct, frozen=True):
    """All packages; also given to ``repository`` hooks with the packages of one repository.

    ``scratch`` is a folder for temporary files that lives as long as the run and is shared by its
    plug-ins. What is left in ``artifacts`` is kept for the user; it is empty where nothing is kept.
    """

    root: str
    packages: tuple[PackageInput, ...]
    repository: str = ""
    options: dict[str, Any] = {}
    scratch: str = ""
    artifacts: str = ""


class ResultsInput(msgspec.Struct, frozen=True):
    """What all plug-ins reported, for the hook that runs after every other."""

    workspace: WorkspaceInput
    findings: tuple[Finding, ...] = ()
    measurements: tuple[Measurement, ...] = ()
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

        ``path`` is below the workspace root, below the package's folder, or absolute. ``entity``
        defaults to the innermost class or function around ``line``. ``context`` is the flagged
        source text, by default the line's; it makes the fingerprint survive line moves.
        """

    def measurement(self, quantity: str, value: float, *, entity: str = "") -> None:
        """Report a value; ``entity`` (the text form of an id) defaults to the file or package analysed."""

    def failure(self, what: str, *, expected: str = "", advice: str = "", line: int = 0) -> None:
        """Report what could not be analysed; what was reported before stays."""

    def attempt(
        self, step: str, call: Callable[[], object], *, path: str = "", package: str = "", always: bool = False
    ) -> bool:
        """Run a part of a long hook so that it fails alone; return whether it ran to its end.

        The time limit starts anew. An exception becomes a failure that names ``step`` (unique in
        the hook), ``path`` and the id of ``package``. When a part hangs or takes the process down,
        the hook starts again in a new process, without the parts that are done and the one that
        failed; ``always`` makes a part run again then, for what others need in memory.
        """
        ...


HOOKS = {
    "file": "analyse_file",
    "package": "analyse_package",
    "repository": "analyse_repository",
    "workspace": "analyse_workspace",
    "results": "analyse_results",
    "configuration": "analyse_configuration",
}
"""Scope to name of the hook; each takes its input and a :class:`Report` and returns nothing.

``results`` runs once, after all others. ``configuration`` is reserved: no hook of this scope is called
before applications are extracted.
"""
