"""Plug-ins in a run: which take part, and the outcomes of the hooks for each package and for all packages."""

from __future__ import annotations

import contextlib
import os
from collections import defaultdict
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

import msgspec

from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo
from roslens.model.quantity import Measurement, Quantity
from roslens.model.source import SourceFile
from roslens.plugins.contract_failures import not_trusted
from roslens.plugins.discovery import Discovered, discover
from roslens.plugins.member import Member
from roslens.plugins.outcome import Outcome
from roslens.plugins.points import FileInput, PackageInput, WorkspaceInput
from roslens.source.settings import SourceSettings
from roslens.source.tools.used import TOOLS, plain
from roslens.source.workspace.find import Workspace

if TYPE_CHECKING:
    from roslens.children.sandbox import Sandbox
    from roslens.plugins.pool import ProcessWorkers
    from roslens.source.measure.analyse_package import MeasuredPackage

GRAPH = "roslens.source.rules.graph:plugin"
BUILTIN = ("roslens.source.tools.cccc:plugin", GRAPH)
"""Plug-ins that come with roslens, as ``module:attribute``."""

ARTIFACTS = "artifacts"
"""Folder for files that plug-ins export, one folder a plug-in."""


def discover_plugins(
    settings: SourceSettings, base: Path, log: Path | None = None, *, configurations: bool = False
) -> Discovered:
    """Return the plug-ins that are there for ``settings``; relative paths start from ``base``.

    Those of ours that only look at configurations are imported where ``configurations`` are looked at, or the settings
    name them: a check of source has no use for them.
    """
    named = configurations or "graph" in {*settings.options, *settings.disable}
    builtin = BUILTIN if named else tuple(one for one in BUILTIN if one != GRAPH)
    disable = [name for name in settings.disable if plain(name) not in TOOLS]
    found = discover(settings.plugins, disable=disable, base=base, builtin=builtin, log=log)
    if settings.untrusted:
        withheld = tuple(not_trusted(name) for name in settings.untrusted)
        found = msgspec.structs.replace(found, failures=(*withheld, *found.failures))
    if all(member.builtin for member in found.members):
        return found
    # What roslens measures itself is only worth importing if a third-party plug-in may need it.
    from roslens.plugins.order import order
    from roslens.source.metrics.table import QUANTITIES

    ordered = order(found.members, frozenset(QUANTITIES))
    return Discovered(ordered.members, (*found.failures, *ordered.failures), found.unavailable)


class PluginStage(AbstractContextManager["PluginStage"]):
    """The plug-ins of one run, with worker processes that live as long as it does."""

    def __init__(
        self,
        found: Discovered,
        settings: SourceSettings,
        wanted: frozenset[str],
        workspace: Workspace,
        files: Mapping[str, tuple[SourceFile, ...]],
        *,
        jobs: int,
        log: Path | None = None,
    ) -> None:
        """Take the plug-ins that have hooks.

        One that comes with roslens runs only where a quality model asks for a quantity that it
        gives (``wanted``): a foreign tool on every file costs more than all the rest.
        """
        self._settings = settings
        self._workspace = workspace
        self.files = files
        self._jobs = jobs
        self._log = log
        # What plug-ins export stands beside their log, and like it is not kept where nothing is.
        self._artifacts = str(log.parent / ARTIFACTS) if log is not None else ""
        self._workers: ProcessWorkers | None = None
        self.members = tuple(member for member in found.members if takes_part(member, wanted))

    @property
    def wide(self) -> bool:
        """Whether a plug-in looks at several packages at once, so that all must be measured before any is finished."""
        return is_wide(self.members)

    @property
    def rules(self) -> tuple[RuleInfo, ...]:
        """The rules of all plug-ins that take part."""
        return tuple(rule for member in self.members for rule in member.manifest.rules)

    @property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities of all plug-ins that take part."""
        return {quantity.key: quantity for member in self.members for quantity in member.manifest.quantities}

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the worker processes."""
        if self._workers is not None:
            self._workers.__exit__(kind, error, trace)
            with contextlib.suppress(OSError):  # it is not empty
                Path(self._artifacts).rmdir() if self._artifacts else None

    def run_package(self, measured: MeasuredPackage) -> Outcome:
        """Return the outcome of the file and package hooks of all plug-ins for a package."""
        members = [member for member in self.members if {"file", "package"} & set(member.manifest.scopes)]
        if not members:
            return Outcome()
        from roslens.plugins.isolation import run_package

        return run_package(
            members,
            self._input(measured),
            root=self._workspace.root,
            options=self._settings.options,
            jobs=self._jobs or 1,
            workers=self._shared_workers(),
        )

    def run_workspace(self, measured: Sequence[MeasuredPackage], outcomes: Sequence[Outcome]) -> Outcome:
        """Return the outcome of the hooks that see all packages."""
        from roslens.plugins.isolation import run_plugins

        packages = tuple(self._input(package) for package in measured)
        workers = self._shared_workers()
        given = WorkspaceInput(self._workspace.root, packages, scratch=workers.scratch(), artifacts=self._artifacts)
        return run_plugins(
            self.members,
            given,
            options=self._settings.options,
            jobs=self._jobs or 1,
            workers=workers,
            findings=[finding for outcome in outcomes for finding in outcome.findings],
            measurements=[measurement for outcome in outcomes for measurement in outcome.measurements],
        )

    def _shared_workers(self) -> ProcessWorkers:
        if self._workers is None:
            from roslens.plugins.pool import ProcessWorkers

            limit, sandbox = self._settings.time_limit_s, self._sandbox()
            self._workers = ProcessWorkers(
                self._jobs or 1, time_limit_s=limit, log=self._log, sandbox=sandbox
            ).__enter__()
        return self._workers

    def _sandbox(self) -> Sandbox | None:
        from roslens.children.plugin_sandbox import plugin_sandbox
        from roslens.source.tools.running.tool_sandbox import readable

        root = self._workspace.root
        read = {*readable(root, (found.folder for found in self._workspace.packages))}
        # Files that the workspace has by a link are read where they are.
        linked = (os.path.join(root, file.path) for held in self.files.values() for file in held)  # noqa: PTH118
        read.update(os.path.realpath(path) for path in linked if os.path.islink(path))  # noqa: PTH114
        if self._artifacts:
            # What is to be written has to be there before the sandbox is.
            Path(self._artifacts).mkdir(parents=True, exist_ok=True)
        own = [member.spec.path for member in self.members if member.spec.path]
        return plugin_sandbox(sorted(read), own, [self._artifacts] if self._artifacts else [], os.environ)

    def _input(self, measured: MeasuredPackage) -> PackageInput:
        found = next(found for found in self._workspace.packages if found.package.id == measured.package)
        root = Path(self._workspace.root)
        files = tuple(
            FileInput(file.path, str(root / file.path), file.language, file.role, measured.package, b"")
            for file in self.files[measured.package]
        )
        return PackageInput(found.package, found.folder, files, measured.entities)


def takes_part(member: Member, wanted: frozenset[str]) -> bool:
    """Return whether a plug-in runs: all that users add do, built-in ones when a model wants what they give."""
    return not member.builtin or any(quantity.key in wanted for quantity in member.manifest.quantities)


def is_wide(members: Sequence[Member]) -> bool:
    """Return whether a plug-in looks at several packages at once."""
    return any({"repository", "workspace", "results"} & set(member.manifest.scopes) for member in members)


def shared_out(outcome: Outcome, files: Mapping[str, tuple[SourceFile, ...]]) -> tuple[dict[str, Outcome], Outcome]:
    """Divide an outcome by package; return it by package id, and the rest."""
    owner = {file.path: package for package, held in files.items() for file in held}

    def package_of(path: str, entity: str) -> str:
        kind, _, name = entity.partition(":")
        if kind == "package" and name in files:
            return name
        return owner.get(path) or owner.get(name.partition("#")[0], "")

    findings: dict[str, list[Finding]] = defaultdict(list)
    for finding in outcome.findings:
        findings[package_of(finding.path, finding.entity)].append(finding)
    measurements: dict[str, list[Measurement]] = defaultdict(list)
    for measurement in outcome.measurements:
        measurements[package_of("", measurement.entity)].append(measurement)
    failures: dict[str, list[Failure]] = defaultdict(list)
    for failure in outcome.failures:
        place = failure.location.path if failure.location else ""
        named = failure.package if failure.package in files else package_of(place, failure.entity)
        failures[named].append(failure)
    parts = {
        package: Outcome(tuple(findings[package]), tuple(measurements[package]), tuple(failures[package]))
        for package in sorted({*findings, *measurements, *failures})
    }
    rest = parts.pop("", Outcome())
    return parts, rest
