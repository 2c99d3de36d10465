"""Plug-ins at work: their hooks called in worker processes, their reports gathered in a fixed order.

No plug-in can stop a run, another plug-in, or its own work on other files: what it does wrong becomes a
failure beside the results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

import msgspec

from roslens.children.scratch_folder import ScratchFolder
from roslens.model.entity import Entity
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.quantity import Measurement
from roslens.plugins.contract_failures import TOOL
from roslens.plugins.frames import FilesTask, PackageTask, ResultsTask, Task, WorkspaceTask
from roslens.plugins.member import Member
from roslens.plugins.order import generations
from roslens.plugins.outcome import Outcome
from roslens.plugins.points import FileInput, PackageInput, ResultsInput, WorkspaceInput
from roslens.plugins.pool import Workers
from roslens.plugins.session import Options, Reported, Session

_FILES_PER_TASK = 64
_TASKS_PER_WORKER = 4


def run_package(
    members: Sequence[Member],
    package: PackageInput,
    *,
    root: str = "",
    options: Options | None = None,
    time_limit_s: float = 60.0,
    jobs: int = 1,
    log: Path | None = None,
    progress: Reported | None = None,
    workers: Workers | None = None,
) -> Outcome:
    """Call the file and package hooks of all plug-ins for one package.

    Args:
        members: the plug-ins; others than those of these scopes are left alone.
        package: the package with its files and what was measured of it.
        root: the workspace root; empty means what is left of ``package.folder`` before its path.
        options: what the user set, by plug-in.
        time_limit_s: seconds that one hook call may take.
        jobs: worker processes; 0 calls hooks in this process without a limit, for a debugger.
        log: receives tracebacks and what plug-ins print.
        progress: hears ``plug-in: file`` or ``plug-in: hook`` of each call that is over.
        workers: workers of an earlier call to use again; ``time_limit_s``, ``jobs`` and ``log`` are theirs.
    """
    root = root or package.folder.removesuffix(package.package.path).rstrip("/") or "/"
    with Session(members, options or {}, time_limit_s, jobs, log, progress, workers) as run:
        package = _sendable(package, run)
        run.perform(_file_tasks(run, package, root, jobs))
        for group in generations([member for member in run.members if "package" in member.manifest.scopes]):
            given = _with_values(package, run.measured)
            run.perform([PackageTask(run.engaged(member), root, given) for member in group])
        return run.outcome()


def run_plugins(
    members: Sequence[Member],
    workspace: WorkspaceInput,
    *,
    options: Options | None = None,
    time_limit_s: float = 60.0,
    jobs: int = 1,
    log: Path | None = None,
    progress: Reported | None = None,
    workers: Workers | None = None,
    findings: Sequence[Finding] = (),
    measurements: Sequence[Measurement] = (),
) -> Outcome:
    """Call the repository and workspace hooks of all plug-ins, then those that see all results.

    ``findings`` and ``measurements`` are what plug-ins reported of the packages (and whatever else
    hooks of scope ``results`` shall see). The other arguments are those of :func:`run_package`.
    """
    with ExitStack() as stack:
        if not workspace.scratch:
            scratch = stack.enter_context(ScratchFolder("scratch"))
            workspace = msgspec.structs.replace(workspace, scratch=scratch)
        run = stack.enter_context(Session(members, options or {}, time_limit_s, jobs, log, progress, workers))
        packages = tuple(_sendable(package, run) for package in workspace.packages)
        workspace = msgspec.structs.replace(workspace, packages=packages)
        run.know(measurements)
        for group in generations([member for member in run.members if _wide(member)]):
            given = _with_all_values(workspace, run.measured)
            run.perform([task for member in group for task in _wide_tasks(run, member, given)])
        before = run.outcome()
        results = ResultsInput(
            _with_all_values(workspace, run.measured),
            findings=(*findings, *before.findings),
            measurements=(*measurements, *before.measurements),
        )
        for group in generations([member for member in run.members if "results" in member.manifest.scopes]):
            run.perform([ResultsTask(run.engaged(member), results) for member in group])
        return run.outcome()


def _sendable(package: PackageInput, run: Session) -> PackageInput:
    """Return the package without files whose names are no text: no worker could be sent them."""
    strange = {file.path for file in package.files if not _is_text(file.path + file.absolute)}
    if not strange:
        return package
    for path in sorted(strange):
        shown = path.encode("utf-8", "backslashreplace").decode()
        run.fail(
            Failure(
                tool=TOOL,
                what=f"the name of '{shown}' is not UTF-8",
                expected="a name that plug-ins can be given",
                advice="Rename the file; no plug-in looked at it",
                package=package.package.id,
            )
        )
    return msgspec.structs.replace(
        package,
        files=tuple(file for file in package.files if file.path not in strange),
        entities=tuple(entity for entity in package.entities if entity.path not in strange),
    )


def _is_text(name: str) -> bool:
    try:
        name.encode()
    except UnicodeEncodeError:
        return False
    return True


def _wide(member: Member) -> bool:
    return bool({"repository", "workspace"} & set(member.manifest.scopes))


def _wide_tasks(run: Session, member: Member, workspace: WorkspaceInput) -> Iterator[Task]:
    if "repository" in member.manifest.scopes:
        for name in sorted({package.package.repository for package in workspace.packages} - {""}):
            inside = tuple(package for package in workspace.packages if package.package.repository == name)
            given = msgspec.structs.replace(workspace, packages=inside, repository=name)
            yield WorkspaceTask(run.engaged(member), given)
    if "workspace" in member.manifest.scopes:
        yield WorkspaceTask(run.engaged(member), workspace)


def _file_tasks(run: Session, package: PackageInput, root: str, jobs: int) -> list[Task]:
    """Cut the files of a package into batches: enough for all workers, few enough to be cheap to send."""
    by_members: dict[tuple[str, ...], list[FileInput]] = {}
    members = {member.name: member for member in run.members if "file" in member.manifest.scopes}
    for file in package.files:
        names = tuple(name for name, member in members.items() if _reads(member, file))
        if names:
            by_members.setdefault(names, []).append(file)
    paths = tuple(file.path for file in package.files)
    entities: dict[str, list[Entity]] = {}
    for entity in package.entities:
        if entity.line:
            entities.setdefault(entity.path, []).append(entity)
    tasks: list[Task] = []
    for names, files in sorted(by_members.items()):
        size = min(_FILES_PER_TASK, -(-len(files) // (max(1, jobs) * _TASKS_PER_WORKER)))
        engaged = tuple(run.engaged(members[name]) for name in names)
        for start in range(0, len(files), size):
            batch = tuple(
                msgspec.structs.replace(file, entities=tuple(entities.get(file.path, ())))
                for file in files[start : start + size]
            )
            tasks.append(FilesTask(engaged, root, package.folder, package.package.id, paths, batch))
    return tasks


def _reads(member: Member, file: FileInput) -> bool:
    return not member.manifest.languages or file.language.value in member.manifest.languages


def _with_values(package: PackageInput, measured: Mapping[str, Mapping[str, float]]) -> PackageInput:
    """Return the package with what plug-ins measured of its entities."""
    if not measured:
        return package
    entities = tuple(
        msgspec.structs.replace(entity, values={**entity.values, **measured[entity.id]})
        if entity.id in measured
        else entity
        for entity in package.entities
    )
    return msgspec.structs.replace(package, entities=entities)


def _with_all_values(workspace: WorkspaceInput, measured: Mapping[str, Mapping[str, float]]) -> WorkspaceInput:
    packages = tuple(_with_values(package, measured) for package in workspace.packages)
    return msgspec.structs.replace(workspace, packages=packages)
