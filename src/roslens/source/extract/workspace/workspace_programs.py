"""The programs of a workspace: those that are known from the cache, the others from a parse in worker processes."""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import blake2b

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import begin_reading, file_budget
from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Location, SourceFile
from roslens.source.engines.executor import executor_for
from roslens.source.extract.ir.program import Program
from roslens.source.extract.ir.program_codec import becomes_nodes, pack, program_keys, unpack
from roslens.source.keys import content_hash
from roslens.source.measure.read_apart import Asked, most_bytes_here, read_apart
from roslens.source.over_budget import as_program, over_budget
from roslens.source.parsed_file import parse_file
from roslens.source.progress import Progress
from roslens.source.settings import MacroSettings
from roslens.store.cache import Cache

_BATCH_BYTES = 400_000
"""So much source is one task: enough to be worth a worker's while, and what a killed run loses at most of each."""


class LowerTask(msgspec.Struct, frozen=True):
    """What a worker needs: files below a root, and what to blank in them. ``number`` identifies the task."""

    number: int
    root: str
    files: tuple[SourceFile, ...]
    macros: MacroSettings


class LoweredFiles(msgspec.Struct, frozen=True):
    """What a worker gives back: programs by path, packed; files that changed since they were looked at apart."""

    programs: dict[str, bytes]
    changed: dict[str, bytes]
    failures: tuple[Failure, ...]


class WorkspacePrograms(msgspec.Struct, frozen=True):
    """The programs of files by path, sorted, and the files of which there is none.

    Attributes:
        programs: by path.
        contents: a key of each program, by path: one of a file whose comments changed is the same.
        failures: what could not be read.
        lasting: whether the next run would find the same: no file could not be read, and none changed meanwhile.
    """

    programs: dict[str, Program]
    contents: dict[str, str]
    failures: tuple[Failure, ...]
    lasting: bool


def workspace_programs(
    root: str, files: Iterable[SourceFile], macros: MacroSettings, *, cache: Cache, jobs: int, watch: Progress
) -> WorkspacePrograms:
    """Return the programs of those files that may become nodes; what was not known is kept.

    Args:
        root: folder that paths start from.
        files: in any order, with the hash of their content.
        macros: what to blank before a parse.
        cache: what earlier runs learned.
        jobs: worker processes; 0 means one per processor.
        watch: who watches.
    """
    parsed = sorted(filter(becomes_nodes, files), key=lambda file: file.path)
    keys = program_keys(parsed, macros)
    found, contents = _known(keys, cache)
    cache.touch(keys[path] for path in found)
    failures: list[Failure] = []
    lasting = True
    tasks = _tasks(root, [file for file in parsed if file.path not in found], macros)
    watch.step("Reading programs", len(tasks))
    for task, result in executor_for(jobs if len(tasks) > 1 else 1).run(lower_files, tasks):
        match result:
            case BaseException():
                failures += [_broken(file, result) for file in task.files]
                lasting = False
            case _:
                cache.put({keys[path]: packed for path, packed in result.programs.items()})
                for path, packed in (*result.programs.items(), *result.changed.items()):
                    found[path], contents[path] = unpack(packed), content_of(packed)
                failures += result.failures
                lasting = lasting and not result.changed and all(one.tool != "read" for one in result.failures)
        watch.advance(item=task.files[-1].path)
    failures.sort(key=lambda failure: failure.location or Location(""))
    return WorkspacePrograms({path: found[path] for path in sorted(found)}, contents, tuple(failures), lasting)


def content_of(packed: bytes) -> str:
    """Return a key of a packed program."""
    return blake2b(packed, digest_size=16).hexdigest()


def _known(keys: Mapping[str, str], cache: Cache) -> tuple[dict[str, Program], dict[str, str]]:
    kept = cache.get(set(keys.values()))
    found: dict[str, Program] = {}
    contents: dict[str, str] = {}
    collecting = gc.isenabled()
    gc.disable()
    try:
        for path, key in keys.items():
            if (packed := kept.get(key)) is not None:
                try:
                    found[path], contents[path] = unpack(packed), content_of(packed)
                except msgspec.DecodeError:
                    # What a damaged cache holds is read from the file again.
                    continue
        # Programs form no cycles: the collector, which would look at each part of them, can pass them by.
        gc.freeze()
    finally:
        if collecting:
            gc.enable()
    return found, contents


def _tasks(root: str, files: Sequence[SourceFile], macros: MacroSettings) -> list[LowerTask]:
    """Return batches of files, the heaviest first."""
    batches: list[list[SourceFile]] = []
    room = 0
    for file in sorted(files, key=lambda one: (-one.size, one.path)):
        if not batches or file.size > room:
            batches.append([])
            room = _BATCH_BYTES
        batches[-1].append(file)
        room -= file.size
    return [LowerTask(number, root, tuple(batch), macros) for number, batch in enumerate(batches)]


def lower_files(task: LowerTask) -> LoweredFiles:
    """Parse files and pack their programs; one that breaks the parser does not lose the others.

    The collector of cyclic garbage is off meanwhile, as programs form no cycles.
    """
    begin_reading()
    collecting = gc.isenabled()
    gc.disable()
    try:
        return _lowered(task)
    finally:
        if collecting:
            gc.enable()


def _lowered(task: LowerTask) -> LoweredFiles:
    programs: dict[str, bytes] = {}
    changed: dict[str, bytes] = {}
    failures: list[Failure] = []
    for file in task.files:
        try:
            content = read_bounded(f"{task.root}/{file.path}")
            if len(content) > most_bytes_here():
                packed = read_apart(Asked(content, file.language, task.macros, program=True)).program
            else:
                with file_budget(as_program(file.path), size=len(content), seconds=SOURCE_FILE_S):
                    packed = pack(parse_file(content, file.language, task.macros).program())
        except OverBudgetError as error:
            failures.append(over_budget(file, error))
            continue
        except Exception as error:  # noqa: BLE001 - a file that breaks the parser must not lose the others
            failures.append(_broken(file, error))
            continue
        (programs if content_hash(content) == file.content_hash else changed)[file.path] = packed
    return LoweredFiles(programs, changed, tuple(failures))


def _broken(file: SourceFile, error: BaseException) -> Failure:
    import traceback

    readable = not isinstance(error, OSError)
    return Failure(
        tool="graph" if readable else "read",
        what=f"{type(error).__name__}: {error}",
        expected="a file whose nodes and endpoints can be read" if readable else "a file that can be read",
        advice="Please report it with the file: this is a bug in roslens" if readable else "Check its permissions",
        location=Location(file.path),
        entity=str(EntityId(EntityKind.FILE, file.path)),
        partial=True,
        detail="".join(traceback.format_exception(error)),
    )


def not_understood(programs: Mapping[str, Program]) -> Iterator[tuple[str, int, str]]:
    """Yield path, line and reason of what was left out of programs."""
    for path, program in programs.items():
        for line, reason in program.incomplete:
            yield path, line, reason
