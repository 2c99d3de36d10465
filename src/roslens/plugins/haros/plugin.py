"""A HAROS plug-in as a plug-in of roslens: its hooks called in HAROS' order, each as a part that fails alone.

The first pass (analysis) is one call for the whole workspace in one process, because HAROS plug-ins share
``iface.state`` over files; the second (processing) comes after the first of all plug-ins and sees what all
HAROS plug-ins reported.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from roslens.model.errors import PluginError
from roslens.plugins.haros.declared import Declared, quantities, read_declared, roslens_languages, rule_infos
from roslens.plugins.haros.interface import Interface
from roslens.plugins.haros.notes import Measurement, Violation, read_notes, write_notes
from roslens.plugins.haros.places import Places
from roslens.plugins.haros.scopes import Package, Project, SourceFile, project_of
from roslens.plugins.hashed_modules import hashed_modules
from roslens.plugins.points import INTERFACE_VERSION, Manifest, Report, ResultsInput, WorkspaceInput

FIRST_PASS = ("pre_analysis", "file_analysis", "package_analysis", "configuration_analysis", "post_analysis")
SECOND_PASS = (
    "pre_process",
    "process_file_violation",
    "process_file_metric",
    "process_package_violation",
    "process_package_metric",
    "process_configuration_violation",
    "process_configuration_metric",
    "post_process",
)


def load_haros_plugin(folder: Path) -> object:
    """Import a HAROS plug-in and return it with the hooks of roslens that it needs.

    Raises:
        PluginError: it is no HAROS plug-in, or has none of HAROS' hooks.
        BaseException: whatever it raises while it is imported.
    """
    declared = read_declared(folder)
    module = _import(folder)
    first = _has(module, FIRST_PASS)
    second = _has(module, SECOND_PASS)
    if not first and not second:
        raise PluginError("plugin.py has no hook", expected=f"any of {', '.join((*FIRST_PASS, *SECOND_PASS))}")
    kind = _Both if first and second else _First if first else _Second
    return kind(declared, folder, module)


def _has(module: ModuleType, hooks: Sequence[str]) -> bool:
    return any(callable(getattr(module, hook, None)) for hook in hooks)


def _import(folder: Path) -> ModuleType:
    """Import ``plugin`` from the package in ``folder``, wherever that is."""
    name = folder.name
    if name not in sys.modules:
        start = folder / "__init__.py"
        found = spec_from_file_location(
            name, start if start.is_file() else None, submodule_search_locations=[str(folder)]
        )
        if found is not None and os.path.realpath(start) in hashed_modules().hashes:
            found = hashed_modules().spec_of(name, str(start))
        if found is None or found.loader is None:
            package = ModuleType(name)
            package.__path__ = [str(folder)]
            sys.modules[name] = package
        else:
            sys.modules[name] = package = module_from_spec(found)
            found.loader.exec_module(package)
    return importlib.import_module(f"{name}.plugin")


class _HarosPlugin:
    """What both passes share."""

    def __init__(self, declared: Declared, folder: Path, module: ModuleType) -> None:
        self._declared = declared
        self._folder = folder
        self._module = module
        self.manifest = Manifest(
            name=declared.name,
            interface=INTERFACE_VERSION,
            version=declared.version,
            text="A plug-in written for HAROS.",
            scopes=self._scopes(),
            languages=roslens_languages(declared.languages),
            quantities=quantities(declared),
            rules=rule_infos(declared),
        )

    def _scopes(self) -> tuple[str, ...]:
        return tuple(scope for scope in ("workspace", "results") if callable(getattr(self, f"analyse_{scope}", None)))

    def _pass(self, workspace: WorkspaceInput, project: Project, report: Report, *, keeps_notes: bool) -> _Pass:
        iface = Interface(self._declared, self._folder, project, Places(project), report)
        return _Pass(self._declared, self._module, workspace, iface, report, keeps_notes=keeps_notes)

    def _first_pass(self, workspace: WorkspaceInput, report: Report) -> None:
        project = project_of(workspace)
        step = self._pass(workspace, project, report, keeps_notes=True)
        for rule in self._declared.rules.values():
            if rule.query:
                report.failure(
                    f"rule {rule.id!r} is a query, which is not evaluated",
                    expected="a rule that the plug-in reports itself",
                    advice="Write it as a hook",
                )
        if not step.begin("pre_analysis"):
            return
        for package in project.packages:
            for file in package.source_files:
                if file.language in self._declared.languages:
                    step.call("file_analysis", file)
        for package in project.packages:
            step.call("package_analysis", package)
        step.end("post_analysis")

    def _second_pass(self, results: ResultsInput, report: Report) -> None:
        project = project_of(results.workspace)
        step = self._pass(results.workspace, project, report, keeps_notes=False)
        notes = read_notes(results.workspace.scratch, project)
        if not step.begin("pre_process"):
            return
        for package in project.packages:
            for file in package.source_files:
                if file.id in notes:
                    step.process("file", file, *notes[file.id])
        for package in project.packages:
            if package.id in notes:
                step.process("package", package, *notes[package.id])
        step.end("post_process")


class _First(_HarosPlugin):
    def analyse_workspace(self, workspace: WorkspaceInput, report: Report) -> None:
        self._first_pass(workspace, report)


class _Second(_HarosPlugin):
    def analyse_results(self, results: ResultsInput, report: Report) -> None:
        self._second_pass(results, report)


class _Both(_First, _Second):
    pass


def _show(hook: Callable[[Interface, object], object], iface: Interface, data: Sequence[object]) -> None:
    for datum in data:
        hook(iface, datum)


class _Pass:
    """One pass of one plug-in: hooks as parts, in the plug-in's temporary folder.

    Only the first pass keeps notes: what is reported in the second is seen by nobody else, as in HAROS.
    """

    def __init__(
        self,
        declared: Declared,
        module: ModuleType,
        workspace: WorkspaceInput,
        iface: Interface,
        report: Report,
        *,
        keeps_notes: bool,
    ) -> None:
        self._declared = declared
        self._module = module
        self._workspace = workspace
        self._iface = iface
        self._report = report
        self._keeps_notes = keeps_notes
        self._folder = Path(workspace.scratch, declared.name)
        self._folder.mkdir(exist_ok=True)

    def begin(self, hook: str) -> bool:
        """Call the hook that makes the state; without it no other makes sense."""
        function = getattr(self._module, hook, None)
        if not callable(function):
            return True

        def make_state() -> None:
            os.chdir(self._folder)
            self._iface.state = function()

        return self._report.attempt(hook, make_state, always=True)

    def call(self, hook: str, scope: SourceFile | Package) -> None:
        """Call a hook for a file or a package."""
        function = getattr(self._module, hook, None)
        if callable(function):
            self._part(hook, scope, lambda: function(self._iface, scope))

    def process(
        self, kind: str, scope: SourceFile | Package, violations: list[Violation], measurements: list[Measurement]
    ) -> None:
        """Show everything that was reported of a file or a package."""
        parts: tuple[tuple[str, Sequence[object]], ...] = (("violation", violations), ("metric", measurements))
        for what, data in parts:
            function = getattr(self._module, f"process_{kind}_{what}", None)
            if callable(function) and data:
                self._part(f"process_{kind}_{what}", scope, partial(_show, function, self._iface, data))

    def end(self, hook: str) -> None:
        """Call the last hook, keep exported files and say what has no place."""
        function = getattr(self._module, hook, None)
        if callable(function):
            self._part(hook, None, lambda: function(self._iface))
        self._iface.keep_exports(self._workspace.artifacts)
        for key, count in sorted(self._iface.unplaced.items()):
            self._report.failure(
                f"{count} values of {key} name functions or classes that are not known",
                expected="names as the source has them",
                advice="They are left out",
            )

    def _part(self, hook: str, scope: SourceFile | Package | None, call: Callable[[], object]) -> None:
        def run() -> None:
            os.chdir(self._folder)
            self._iface.scope = scope
            try:
                call()
            finally:
                self._iface.flush()
                if self._keeps_notes:
                    write_notes(self._workspace.scratch, self._declared, self._iface.notes)
                self._iface.notes.clear()

        if isinstance(scope, SourceFile):
            self._report.attempt(f"{hook} {scope.given.path}", run, path=scope.given.path, package=scope.given.package)
        elif isinstance(scope, Package):
            self._report.attempt(f"{hook} {scope.given.package.id}", run, package=scope.given.package.id)
        else:
            self._report.attempt(hook, run)
