"""What a worker does for a task: load plug-ins, call their hooks, catch whatever they do."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import PluginError
from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.plugins.contract_failures import RAISED_ADVICE, breaks_contract, failed_running, would_not_load
from roslens.plugins.frames import (
    LOADING,
    Answer,
    Began,
    Ended,
    Engaged,
    FilesTask,
    Gave,
    Loaded,
    LoadTask,
    Order,
    PackageTask,
    Step,
    WorkspaceTask,
)
from roslens.plugins.grounds import Grounds, file_grounds, package_grounds, workspace_grounds
from roslens.plugins.manifest import hooks_of, read_manifest
from roslens.plugins.member import LoadSpec, fingerprint_of, load_plugin
from roslens.plugins.points import HOOKS, FileInput, Manifest
from roslens.plugins.recorder import Recorder

Emit = Callable[[Answer], None]


class Performer:
    """Carries out tasks; plug-ins stay loaded from one task to the next."""

    def __init__(self, emit: Emit) -> None:
        """Send answers through ``emit``."""
        self.emit = emit
        self._loaded: dict[str, tuple[object, Manifest] | None] = {}

    def perform(self, order: Order) -> None:
        """Carry out a task, step by step, without those that the order says are done or dead."""
        task = order.task
        steps = _Steps(order, self.emit)
        if isinstance(task, LoadTask):
            self._introduce(task, steps)
        elif isinstance(task, FilesTask):
            self._look_at_files(task, steps)
        elif isinstance(task, PackageTask):
            grounds = package_grounds(task.package, root=task.root)
            self._call_once(task.plugin, "package", task.package, grounds, steps)
        elif isinstance(task, WorkspaceTask):
            scope = "repository" if task.workspace.repository else "workspace"
            self._call_once(task.plugin, scope, task.workspace, workspace_grounds(task.workspace), steps)
        else:
            self._call_once(task.plugin, "results", task.results, workspace_grounds(task.results.workspace), steps)
        self.emit(Ended())

    def _introduce(self, task: LoadTask, steps: _Steps) -> None:
        """Import a plug-in and tell what it declares."""
        if not steps.begin(Began(Step(task.name, LOADING))):
            return
        plugin, failure = _import(task.name, task.spec)
        if failure is not None:
            self.emit(Loaded(failure=failure))
            return
        manifest = read_manifest(plugin)
        hooks = hooks_of(plugin)
        if isinstance(manifest, Manifest):
            self.emit(Loaded(manifest, hooks, fingerprint_of(task.spec)))
        else:
            self.emit(Loaded(failure=breaks_contract(task.name, manifest)))

    def _look_at_files(self, task: FilesTask, steps: _Steps) -> None:
        for file in task.files:
            wanted = [engaged for engaged in task.plugins if not steps.over(Step(engaged.name, file.path))]
            content = _content(file, wanted, steps) if wanted else None
            if content is None:
                continue
            for engaged in wanted:
                if (ready := self._ready(engaged, steps)) is not None:
                    given = msgspec.structs.replace(file, content=content, options=engaged.options)
                    grounds = file_grounds(given, root=task.root, folder=task.folder, paths=task.paths)
                    step = Began(Step(engaged.name, file.path), file.path, file.package)
                    _call(ready, HOOKS["file"], given, grounds, step, steps)

    def _call_once(self, engaged: Engaged, scope: str, given: msgspec.Struct, grounds: Grounds, steps: _Steps) -> None:
        """Call the one hook of a task."""
        hook = HOOKS[scope]
        step = Began(Step(engaged.name, hook), package=grounds.package)
        if not steps.over(step.step) and (ready := self._ready(engaged, steps)) is not None:
            _call(ready, hook, msgspec.structs.replace(given, options=engaged.options), grounds, step, steps)

    def _ready(self, engaged: Engaged, steps: _Steps) -> tuple[object, Manifest] | None:
        """Return the loaded plug-in; None when it would not load, which is then reported once."""
        loading = Step(engaged.name, LOADING)
        if engaged.name not in self._loaded:
            if not steps.begin(Began(loading)):
                return None
            plugin, failure = _import(engaged.name, engaged.spec)
            manifest = None if failure else read_manifest(plugin)
            self._loaded[engaged.name] = (plugin, manifest) if isinstance(manifest, Manifest) else None
            steps.gave(loading, failure)
        return None if loading in steps.dead else self._loaded[engaged.name]


class _Steps:
    """The steps of one order: which still run, and what is reported of them."""

    def __init__(self, order: Order, emit: Emit) -> None:
        self.done = order.done
        self.dead = order.dead
        self.emit = emit

    def over(self, step: Step) -> bool:
        return step in self.done or step in self.dead or Step(step.plugin, LOADING) in self.dead

    def begin(self, began: Began) -> bool:
        if began.step in self.dead:
            return False
        self.emit(began)
        return True

    def gave(self, step: Step, failure: Failure | None) -> None:
        self.emit(Gave(step, failures=(failure,) if failure else ()))

    def run(self, began: Began, name: str, recorder: Recorder, call: Callable[[], object]) -> bool:
        """Call a hook or a part of one; tell what it reported, its exception included."""
        self.begin(began)
        wrong = _caught(call)
        if wrong:
            grounds = recorder.grounds
            path = began.path or grounds.default_path
            recorder.failures.append(
                failed_running(
                    began.step.plugin,
                    name,
                    wrong[0],
                    location=Location(path) if path else None,
                    entity=f"file:{path}" if path else grounds.default_entity,
                    package=began.package or grounds.package,
                    detail=wrong[1],
                    advice=_advice(wrong[0]),
                )
            )
        self.emit(Gave(began.step, *recorder.drain()))
        return not wrong


class _Parts:
    """Runs parts of a hook as steps of their own; see :meth:`roslens.plugins.points.Report.attempt`."""

    def __init__(self, whole: Began, steps: _Steps) -> None:
        self._whole = whole
        self._steps = steps
        self._inside = False

    def attempt(self, recorder: Recorder, name: str, call: Callable[[], object], began: Began, *, always: bool) -> bool:
        """Run a part; return whether it ran to its end."""
        steps = self._steps
        if self._inside:
            call()
            return True
        if began.step in steps.dead:
            return False
        if began.step in steps.done and not always:
            return True
        steps.emit(Gave(self._whole.step, *recorder.drain(), over=False))
        self._inside = True
        well = steps.run(began, name, recorder, call)
        self._inside = False
        steps.emit(self._whole)
        return well


def _call(
    ready: tuple[object, Manifest], hook: str, given: msgspec.Struct, grounds: Grounds, began: Began, steps: _Steps
) -> None:
    plugin, manifest = ready
    recorder = Recorder(manifest, grounds, _Parts(began, steps))
    here = _folder()
    steps.run(began, hook, recorder, lambda: getattr(plugin, hook)(given, recorder))
    if here:
        os.chdir(here)


def _caught(call: Callable[[], object]) -> tuple[str, str] | None:
    """Run foreign code; return what it raised in a few words, and the traceback."""
    try:
        call()
    except PluginError as error:
        return str(error), traceback.format_exc()
    except SystemExit as error:
        return f"it called sys.exit({error.code!r})", traceback.format_exc()
    except BaseException as error:  # noqa: BLE001 - whatever a plug-in does must not stop the others
        words = " ".join(str(error).split())
        return f"{type(error).__name__}: {words}" if words else type(error).__name__, traceback.format_exc()
    return None


def _advice(wrong: str) -> str:
    """Return what to do about an exception of a plug-in."""
    if wrong.startswith("PermissionError"):
        return (
            "Plug-ins read the workspace, write their scratch and use no network where there is a sandbox "
            "(docs/reference/plugins.md); $ROSLENS_PLUGIN_SANDBOX=off lets them do what you may"
        )
    return RAISED_ADVICE


def _import(name: str, spec: LoadSpec) -> tuple[object, Failure | None]:
    loaded: list[object] = []
    wrong = _caught(lambda: loaded.append(load_plugin(spec)))
    if wrong is None:
        return loaded[0], None
    if wrong[0].startswith(("ModuleNotFoundError", "ImportError")):
        expected, advice = (
            "every module that it imports",
            "Install its dependencies in the environment of roslens, or disable it",
        )
    else:
        expected, advice = "", "The traceback is in the log; `disable` in roslens.toml leaves the plug-in out"
    return None, would_not_load(name, wrong[0], expected=expected, advice=advice, detail=wrong[1])


def _content(file: FileInput, wanted: list[Engaged], steps: _Steps) -> bytes | None:
    """Return the content of a file; when it cannot be read, tell so once for all plug-ins."""
    try:
        return read_bounded(file.absolute)
    except OSError as error:
        failure = Failure(
            tool="read",
            what=f"{type(error).__name__}: {error.strerror}",
            expected="a file that can be read",
            advice="Check its permissions",
            location=Location(file.path),
            entity=f"file:{file.path}",
            package=file.package,
        )
        for engaged in wanted:
            steps.begin(Began(Step(engaged.name, file.path), file.path, file.package))
            steps.gave(Step(engaged.name, file.path), failure)
        return None


def _folder() -> str:
    try:
        return str(Path.cwd())
    except OSError:
        return ""
