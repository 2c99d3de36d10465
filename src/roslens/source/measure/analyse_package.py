"""One package from bytes to measured entities: the task that workers run."""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.file_budget import begin_reading, file_budget
from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.result import RoleInclude
from roslens.model.source import Language, Location, Package, SourceFile
from roslens.model.words.plural import plural
from roslens.source.measure.analyse_file import FileAnalysis, analyse_parsed
from roslens.source.measure.package_task import PackageTask
from roslens.source.measure.read_apart import Asked, most_bytes_here, read_apart
from roslens.source.measure.remembered_facts import KnownFile, RememberedFacts
from roslens.source.measure.role_includes import role_includes
from roslens.source.over_budget import as_program, over_budget, over_budget_beside
from roslens.source.parsed_file import ParsedFile, parse_file
from roslens.source.rules.hit import Hit
from roslens.source.workspace.suppress import Suppression
from roslens.store.cache import Cache

MOST_LINES = 8
"""Of a file with more places that cannot be parsed, the first ones are reported, and how many more there are."""

_ADVICE = {
    "cpp": "The rest of the file is measured; if this is a macro of yours, name it under [macros] in roslens.toml",
    "python": "The rest of the file is measured; fix the place, or name the file under `ignore` in roslens.toml",
}


class MeasuredPackage(msgspec.Struct, frozen=True):
    """What a worker gives back; ``analyses`` and programs are those that were not in the cache, encoded.

    ``evaluated`` is what rules evaluated, which replaces what the cache has. ``in_part`` says that not all of its
    sources were looked at; ``lost`` that it could not be measured at all.
    """

    package: str
    entities: tuple[Entity, ...]
    failures: tuple[Failure, ...]
    suppressions: dict[str, tuple[Suppression, ...]]
    analyses: dict[str, bytes]
    findings: tuple[Finding, ...] = ()
    in_part: bool = False
    includes: tuple[RoleInclude, ...] = ()
    lost: bool = False
    evaluated: dict[str, bytes] = {}


def measure_task(task: PackageTask, remembered: RememberedFacts | None = None) -> MeasuredPackage:
    """Parse what is new, measure everything.

    ``remembered`` are files of an earlier look in this process.

    The collector of cyclic garbage is off meanwhile: facts form no cycles, and walking half a
    million of them again and again would take a fifth of the time.
    """
    begin_reading()
    collecting = gc.isenabled()
    gc.disable()
    try:
        return _measure(task, remembered or RememberedFacts())
    finally:
        if collecting:
            gc.enable()


def nothing_measured(task: PackageTask, error: BaseException) -> MeasuredPackage:
    """Return what is left of a package whose measuring ended in ``error``: its name and a failure."""
    import traceback

    failure = Failure(
        tool="metrics",
        what=f"the package could not be measured: {type(error).__name__}: {error}",
        expected="measurements of its files, classes and functions",
        advice="Please report it with the package: this is a bug in roslens",
        entity=str(EntityId(EntityKind.PACKAGE, task.package.id)),
        package=task.package.id,
        detail="".join(traceback.format_exception(error)),
    )
    entity = Entity(str(EntityId(EntityKind.PACKAGE, task.package.id)), EntityKind.PACKAGE, task.package.name)
    return MeasuredPackage(task.package.id, (entity,), (failure,), {}, {}, lost=True)


def _measure(task: PackageTask, remembered: RememberedFacts) -> MeasuredPackage:
    from roslens.source.metrics.measure_file import measure_file
    from roslens.source.metrics.measure_package import measure_package
    from roslens.source.rules.package_findings import rule_findings
    from roslens.source.rules.package_view import PackageView
    from roslens.source.syntax.facts import FileFacts

    before = remembered.of(task.package.id)
    known, lowered = _known(task, before)
    new: dict[str, bytes] = {}
    failures: list[Failure] = []
    suppressions: dict[str, tuple[Suppression, ...]] = {}
    measured: list[tuple[SourceFile, FileFacts, tuple[Entity, ...]]] = []
    hits: dict[str, tuple[Hit, ...]] = {}
    callbacks: set[str] = set()
    kept: dict[tuple[str, str], KnownFile] = {}
    for file, analysis in _analyses(task, known, before, lowered, new, failures):
        if analysis.encoding is not None:
            failures.append(_placed(analysis.encoding, file, task.package))
            if not analysis.encoding.partial:
                # What is no text has no lines, comments or places: nothing else can be said of it.
                continue
        if analysis.suppressions:
            suppressions[file.path] = analysis.suppressions
        failures.extend(_faults(file, task.package, analysis))
        failures.extend(_placed(failure, file, task.package) for failure in analysis.matched.failures)
        hits[file.path] = analysis.matched.hits
        callbacks.update(analysis.callbacks)
        place = (file.path, task.facts_keys[file.path])
        one = before.get(place)
        entities = measure_file(file.path, analysis.facts, task.counting) if one is None else one.entities
        size = one.size if one is not None else len(known.get(place[1]) or new.get(place[1]) or b"")
        kept[place] = KnownFile(analysis, entities, size)
        measured.append((file, analysis.facts, entities))
    remembered.remember(task.package.id, kept)
    entities = measure_package(task.package, measured, task.counting)
    known_callbacks: frozenset[str] | set[str] = callbacks
    if task.left_out:
        from roslens.source.measure.part_of_package import registered_elsewhere, without_the_whole

        entities = without_the_whole(entities)
        known_callbacks = registered_elsewhere(task, hits, callbacks)
    of_files = {file.path: facts for file, facts, _ in measured}
    with Cache.open(task.known_in, writable=False) as cache:
        view = PackageView(task.package, task.root, task.files, of_files, task.texts, task.others, task.around, cache)
        findings = rule_findings(view, task.rules, hits, known_callbacks, entities, failures)
    suppressions.update(_of_other_files(task, findings))
    failures.extend(over_budget_beside(task.files, task.package.id, failures))
    return MeasuredPackage(
        task.package.id,
        entities,
        tuple(failures),
        suppressions,
        new,
        findings,
        in_part=bool(task.left_out),
        evaluated=dict(view.new),
        includes=role_includes(((file, facts) for file, facts, _ in measured), own=(task.package.name,)),
    )


_COMMENTED = frozenset({Language.CMAKE, Language.MANIFEST, Language.LAUNCH_XML, Language.LAUNCH_YAML})
"""Languages without a syntax in whose files rules find something."""
_LARGEST_BYTES = 1 << 20


def _of_other_files(task: PackageTask, findings: Iterable[Finding]) -> Iterator[tuple[str, tuple[Suppression, ...]]]:
    """Yield the suppressions of files that are not parsed, where rules find something in their kind or in them."""
    from roslens.source.workspace.suppress import suppressions

    found = {finding.path for finding in findings}
    for file in task.files:
        if file.language.parsed_as or file.size > _LARGEST_BYTES:
            continue
        if file.language in _COMMENTED or file.path in found:
            # A file that is gone meanwhile has none; its own reader reports that.
            with suppress(OSError, OverBudgetError):
                text = task.texts.get(file.path)
                content = read_bounded(Path(task.root, file.path), _LARGEST_BYTES) if text is None else text
                with file_budget(file.path, size=len(content)):
                    known = suppressions(content)
                if known:
                    yield file.path, known


def _known(
    task: PackageTask, before: Mapping[tuple[str, str], KnownFile]
) -> tuple[Mapping[str, bytes], frozenset[str]]:
    if not task.cache:
        return {}, frozenset()
    with Cache.open(Path(task.cache), writable=False) as cache:
        return cache.get(
            key for place in task.facts_keys.items() if place not in before for key in place[1:]
        ), cache.known(task.program_keys.values())


def _analyses(
    task: PackageTask,
    known: Mapping[str, bytes],
    before: Mapping[tuple[str, str], KnownFile],
    lowered: frozenset[str],
    new: dict[str, bytes],
    failures: list[Failure],
) -> Iterator[tuple[SourceFile, FileAnalysis]]:
    decoder = msgspec.msgpack.Decoder(FileAnalysis)
    for file in task.files:
        key = task.facts_keys.get(file.path)
        if key is None:
            continue
        if (one := before.get((file.path, key))) is not None and file.path not in task.program_keys:
            yield file, one.analysis
            continue
        blob = known.get(key)
        program = _program_to_make(task, file, lowered)
        if blob is not None and program is None:
            yield file, decoder.decode(blob)
            continue
        read = _large if file.size > most_bytes_here() else _small
        looked = read(task, file, blob, decoder, program, new)
        if isinstance(looked, Failure):
            failures.append(looked)
        else:
            yield file, looked


def _program_to_make(task: PackageTask, file: SourceFile, lowered: frozenset[str]) -> str | None:
    """Return the key under which the program of a file is wanted and not there yet."""
    key = task.program_keys.get(file.path)
    return None if key in lowered else key


def _looked_at(
    task: PackageTask, file: SourceFile, blob: bytes | None, decoder: msgspec.msgpack.Decoder[FileAnalysis]
) -> tuple[ParsedFile, FileAnalysis] | Failure:
    """Parse a file, and analyse it unless ``blob`` holds what that gave; what breaks it must not lose its package."""
    try:
        text = task.texts.get(file.path)
        content = read_bounded(f"{task.root}/{file.path}") if text is None else text
        with file_budget(file.path, size=len(content), seconds=SOURCE_FILE_S):
            parsed = parse_file(content, file.language, task.macros)
            analysis = analyse_parsed(content, parsed, task.wanted) if blob is None else decoder.decode(blob)
            return parsed, analysis
    except OverBudgetError as error:
        return over_budget(file, error, package=task.package.id)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is this file's
        return _broken(file, task.package, error)


_encode = msgspec.msgpack.Encoder().encode


def _small(
    task: PackageTask,
    file: SourceFile,
    blob: bytes | None,
    decoder: msgspec.msgpack.Decoder[FileAnalysis],
    program: str | None,
    new: dict[str, bytes],
) -> FileAnalysis | Failure:
    """Read a file here, and keep what was not known of it."""
    looked = _looked_at(task, file, blob, decoder)
    if isinstance(looked, Failure):
        return looked
    parsed, analysis = looked
    if blob is None:
        new[task.facts_keys[file.path]] = _encode(analysis)
    if program is not None:
        _lower(file, parsed, program, new)
    return analysis


def _large(
    task: PackageTask,
    file: SourceFile,
    blob: bytes | None,
    decoder: msgspec.msgpack.Decoder[FileAnalysis],
    program: str | None,
    new: dict[str, bytes],
) -> FileAnalysis | Failure:
    """Read a large file in a process of its own, and keep what was not known of it."""
    try:
        text = task.texts.get(file.path)
        content = read_bounded(f"{task.root}/{file.path}") if text is None else text
        asked = Asked(content, file.language, task.macros, blob is None, program is not None, task.wanted)
        given = read_apart(asked)
        analysis = decoder.decode(given.analysis if blob is None else blob)
    except OverBudgetError as error:
        return over_budget(file, error, package=task.package.id)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is this file's
        return _broken(file, task.package, error)
    if blob is None:
        new[task.facts_keys[file.path]] = given.analysis
    if program is not None:
        new[program] = given.program
    return analysis


def _lower(file: SourceFile, parsed: ParsedFile, key: str, new: dict[str, bytes]) -> None:
    from roslens.source.extract.ir.program_codec import pack

    # What cannot be lowered is tried again, and reported, by who asks for the graph.
    with suppress(Exception), file_budget(as_program(file.path), size=file.size, seconds=SOURCE_FILE_S):
        new[key] = pack(parsed.program())


def _placed(failure: Failure, file: SourceFile, package: Package) -> Failure:
    """Return a failure that was kept by content with the file it is about."""
    where = Location(file.path)
    if failure.location is not None:
        where = msgspec.structs.replace(failure.location, path=file.path)
    entity = str(EntityId(EntityKind.FILE, file.path))
    return msgspec.structs.replace(failure, location=where, entity=entity, package=package.id)


def _broken(file: SourceFile, package: Package, error: Exception) -> Failure:
    import traceback

    readable = not isinstance(error, OSError)
    return Failure(
        tool="syntax" if readable else "read",
        what=f"{type(error).__name__}: {error}",
        expected="a file that can be parsed" if readable else "a file that can be read",
        advice="Please report it with the file: this is a bug in roslens" if readable else "Check its permissions",
        location=Location(file.path),
        entity=str(EntityId(EntityKind.FILE, file.path)),
        package=package.id,
        detail="".join(traceback.format_exception(error)),
    )


def _faults(file: SourceFile, package: Package, analysis: FileAnalysis) -> Iterator[Failure]:
    """Yield what of a file could not be parsed: one failure, however many places there are.

    Zero bytes, which are reported as such, are no places.
    """
    faults = analysis.facts.faults
    if analysis.encoding is not None:
        faults = tuple(fault for fault in faults if fault.text.strip("\0 "))
    if not faults:
        return
    first = faults[0]
    what = f"cannot parse `{first.text}`"
    if len(faults) > 1:
        lines = ", ".join(str(fault.line) for fault in faults[1:MOST_LINES])
        more = f" and {plural(len(faults) - MOST_LINES, 'more place')}" if len(faults) > MOST_LINES else ""
        what = f"cannot parse {len(faults)} places: `{first.text}` here, then from line {lines}{more}"
    yield Failure(
        tool="syntax",
        what=what,
        expected=f"{file.language.value} source",
        advice=_ADVICE[file.language.parsed_as],
        location=Location(file.path, first.line, first.column, first.end_line),
        entity=str(EntityId(EntityKind.FILE, file.path)),
        package=package.id,
        partial=True,
    )
