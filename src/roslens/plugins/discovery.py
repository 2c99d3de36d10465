"""Which plug-ins there are: installed ones, files and folders that a user names, HAROS plug-ins.

Metadata tells which candidates exist before any of them is imported. Then each is imported in a worker
process with a time limit: one that raises, exits, crashes or hangs at import becomes a failure.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

import msgspec

from roslens.model.failure import Failure
from roslens.plugins.contract_failures import TOOL, breaks_contract, would_not_load
from roslens.plugins.hashed_modules import hashes_of
from roslens.plugins.installed import HAROS_PREFIX, Installed, find_installed
from roslens.plugins.manifest import check_manifest, hooks_of, read_manifest
from roslens.plugins.member import LoadSpec, Member, Source, load_plugin
from roslens.plugins.nearest import did_you_mean
from roslens.plugins.order import Unavailable, order
from roslens.plugins.points import Manifest

LOAD_LIMIT_S = 20.0
"""Seconds that the import of a plug-in may take."""

OWN_DISTRIBUTION = "roslens"


class Discovered(msgspec.Struct, frozen=True):
    """The plug-ins that may run, by name, and why others may not.

    ``unavailable`` names built-in ones among the members whose program is not installed: calling
    them yields nothing but failures.
    """

    members: tuple[Member, ...] = ()
    failures: tuple[Failure, ...] = ()
    unavailable: tuple[Unavailable, ...] = ()


class _Candidate(msgspec.Struct, frozen=True):
    label: str
    origin: str
    spec: LoadSpec
    builtin: bool = False


def discover(
    paths: Sequence[str],
    *,
    disable: Sequence[str] = (),
    base: Path,
    builtin: Sequence[str] = (),
    provided: Collection[str] | None = None,
    search: Sequence[str] | None = None,
    time_limit_s: float = LOAD_LIMIT_S,
    log: Path | None = None,
) -> Discovered:
    """Find, load and check plug-ins.

    Args:
        paths: files or folders of plug-ins, relative to ``base``.
        disable: names of plug-ins, or of their entry points, to leave out; they are not imported.
            HAROS plug-ins may be named without their prefix.
        base: the folder that ``paths`` start from.
        builtin: plug-ins that come with roslens, as ``module:attribute``; imported in this process.
        provided: keys of quantities that are measured without any plug-in; None when that is not known.
        search: folders to look for installed plug-ins in; None means ``sys.path``.
        time_limit_s: seconds that one import may take.
        log: receives what plug-ins print at import.
    """
    candidates = [*_builtin(builtin), *_installed(find_installed(_search_path(base) if search is None else search))]
    failures: list[Failure] = []
    for path in paths:
        found = _from_path(path, base)
        if isinstance(found, Failure):
            failures.append(found)
        else:
            candidates.append(found)
    hidden = {name for given in disable for name in (given, HAROS_PREFIX + given)}
    members: dict[str, Member] = {}
    for item in _load([one for one in candidates if one.label not in hidden], time_limit_s, log, base):
        if isinstance(item, Failure):
            failures.append(item)
        elif item.name in members:
            failures.append(_doubled(item, members[item.name]))
        else:
            members[item.name] = item
    failures.extend(_misspelt(disable, {candidate.label for candidate in candidates} | set(members)))
    ordered = order([members[name] for name in sorted(members) if name not in hidden], provided)
    failures.extend(ordered.failures)
    able = {member.name for member in ordered.members} | {item.plugin for item in ordered.unavailable}
    return Discovered(tuple(members[name] for name in sorted(able)), tuple(failures), ordered.unavailable)


def _load(
    candidates: Sequence[_Candidate], time_limit_s: float, log: Path | None, base: Path
) -> Iterator[Member | Failure]:
    """Load built-in plug-ins here, which are ours, and all others in a worker."""
    yield from (_load_here(candidate) for candidate in candidates if candidate.builtin)
    if foreign := [candidate for candidate in candidates if not candidate.builtin]:
        yield from _load_apart(foreign, time_limit_s, log, base)


def load_reference(reference: str, *, time_limit_s: float = LOAD_LIMIT_S) -> Member | Failure:
    """Load one plug-in, given as ``module``, ``module:attribute`` or a path: for tests of plug-ins."""
    if Path(reference).exists():
        candidate = _from_path(reference, Path())
        if isinstance(candidate, Failure):
            return candidate
    else:
        module, _, attribute = reference.partition(":")
        spec = LoadSpec(Source.MODULE, module=module, attribute=attribute)
        candidate = _Candidate(module, f"module {module}", spec)
    return next(_load_apart([candidate], time_limit_s, None, None))


def _search_path(base: Path) -> list[str]:
    """Return ``sys.path`` without the folder to analyse: nothing in it runs because it lies there."""
    here = {os.path.realpath(base), os.path.realpath(Path.cwd())}
    return [folder for folder in sys.path if folder and os.path.realpath(folder) not in here]


def _builtin(references: Sequence[str]) -> Iterator[_Candidate]:
    for reference in references:
        module, _, attribute = reference.partition(":")
        spec = LoadSpec(Source.MODULE, module=module, attribute=attribute)
        yield _Candidate(module.rpartition(".")[2], "built in", spec, builtin=True)


def _installed(found: Installed) -> Iterator[_Candidate]:
    for point in found.entry_points:
        spec = LoadSpec(Source.MODULE, module=point.module, attribute=point.attribute)
        origin = f"entry point {point.name} of {point.distribution} {point.version}"
        yield _Candidate(point.name, origin, spec, builtin=point.distribution == OWN_DISTRIBUTION)
    for folder in found.haros:
        name = Path(folder).name
        yield _Candidate(name, f"HAROS plug-in {name}", LoadSpec(Source.HAROS, path=folder))


def _from_path(path: str, base: Path) -> _Candidate | Failure:
    target = Path(os.path.abspath(base / path))  # noqa: PTH100 - symbolic links stay as the user wrote them
    expected = "a file that ends in .py, a package folder, or a folder of a HAROS plug-in"
    if not target.exists():
        return would_not_load(
            path, "there is no such file", expected=expected, advice="Correct `plugins` in roslens.toml"
        )
    if (target / "plugin.yaml").is_file():
        return _Candidate(target.name, f"HAROS plug-in {path}", _spec_of(Source.HAROS, target, base))
    if (target / "__init__.py").is_file() or (target.is_file() and target.suffix == ".py"):
        return _Candidate(target.stem, f"file {path}", _spec_of(Source.FILE, target, base))
    advice = "Install it, then it is found without a path" if (target / "pyproject.toml").is_file() else ""
    return would_not_load(path, "it is not a plug-in", expected=expected, advice=advice)


def _spec_of(source: Source, target: Path, base: Path) -> LoadSpec:
    """Return how a plug-in of a path is loaded: from the bytes that it has now, and nothing beside it."""
    guarded = base if target.is_relative_to(base.absolute()) else target.parent
    return LoadSpec(source, path=str(target), hashes=hashes_of(target), guarded=os.path.realpath(guarded))


def _load_here(candidate: _Candidate) -> Member | Failure:
    import traceback

    try:
        plugin = load_plugin(candidate.spec)
    except Exception as error:  # noqa: BLE001 - a fault in one of ours must not stop the others
        what = f"{type(error).__name__}: {error}"
        advice = "Please report it: this is a fault of roslens"
        return would_not_load(candidate.label, what, advice=advice, detail=traceback.format_exc())
    manifest = read_manifest(plugin)
    if not isinstance(manifest, Manifest):
        return breaks_contract(candidate.label, manifest)
    return _member(candidate, manifest, hooks_of(plugin), manifest.version)


def _member(candidate: _Candidate, manifest: Manifest, hooks: tuple[str, ...], fingerprint: str) -> Member | Failure:
    breaches = check_manifest(manifest, hooks, builtin=candidate.builtin)
    if not breaches:
        return Member(manifest, candidate.origin, candidate.spec, hooks, fingerprint, candidate.builtin)
    failure = breaks_contract(manifest.name or candidate.label, breaches[0])
    if len(breaches) > 1:
        rest = "; ".join(breach.what for breach in breaches[1:])
        failure = msgspec.structs.replace(failure, what=f"{failure.what}; also: {rest}")
    return failure


def _load_apart(
    candidates: Sequence[_Candidate], time_limit_s: float, log: Path | None, base: Path | None
) -> Iterator[Member | Failure]:
    from roslens.children.plugin_sandbox import plugin_sandbox
    from roslens.plugins.frames import Loaded, LoadTask
    from roslens.plugins.job import Job
    from roslens.plugins.pool import ProcessWorkers

    jobs = [Job(LoadTask(candidate.label, candidate.spec), plugins=()) for candidate in candidates]
    paths = [candidate.spec.path for candidate in candidates if candidate.spec.path]
    sandbox = plugin_sandbox([str(base)], paths, (), os.environ) if base is not None else None
    with ProcessWorkers(1, load_limit_s=time_limit_s, log=log, sandbox=sandbox) as workers:
        workers.run(jobs)
    for candidate, job in zip(candidates, jobs, strict=True):
        answer = next((answer for answer in job.answers if isinstance(answer, Loaded)), None)
        if answer is None:
            yield _lost(candidate, job.deaths[-1].why, job.deaths[-1].output)
        elif answer.failure is not None:
            yield answer.failure
        elif answer.manifest is not None:
            yield _member(candidate, answer.manifest, answer.hooks, answer.fingerprint)


def _lost(candidate: _Candidate, why: str, output: str) -> Failure:
    advice = "`disable` in roslens.toml leaves it out"
    return would_not_load(candidate.label, f"while it was imported, {why}", advice=advice, detail=output)


def _doubled(second: Member, first: Member) -> Failure:
    return Failure(
        tool=TOOL,
        what=f"two plug-ins are called {second.name!r}: {first.origin} and {second.origin}",
        expected="one plug-in of a name",
        advice=f"The first is used; disable or rename {second.origin}",
    )


def _misspelt(disable: Sequence[str], labels: set[str]) -> Iterator[Failure]:
    """A name to disable that is nearly one that is there was meant to be that one."""
    for name in disable:
        if name in labels or HAROS_PREFIX + name in labels:
            continue
        if near := did_you_mean(name, labels):
            what = f"{name!r} in `disable` is not an installed plug-in"
            yield Failure(tool=TOOL, what=what, expected=f"one of {', '.join(sorted(labels))}", advice=near)
