"""What ``--baseline`` compares with: a report, a kept run or a revision, with the findings that it had."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from roslens.model.errors import RoslensError, UsageError
from roslens.model.failure import Failure
from roslens.model.finding import Finding, Severity
from roslens.model.interfaces.interface_change import InterfaceDifference

if TYPE_CHECKING:
    from roslens.cli.git.revision import Revision
    from roslens.cli.workplace.configuration import Configuration
    from roslens.store.read import RunView
    from roslens.store.runs import Store

MOST_BYTES = 1_000_000_000
"""A larger report is not read."""

GRAPH_SCOPE = "configuration"
"""Scope of the rules that look at computation graphs."""
GRAPHS = "computationGraphs"
"""Property of a run in SARIF: whether it looked at computation graphs."""
LAST = "last"
"""Names the newest run before this one."""


class Baseline(msgspec.Struct, frozen=True):
    """What a run is compared with.

    ``files`` are git's hashes of the files there were by path, None where that is not known; ``renamed`` are paths of
    files now by those of the baseline; ``graphs`` is whether it looked at computation graphs; ``interfaces`` is how
    messages, services and actions differ from those of a revision, None where that is not known.
    """

    title: str
    findings: tuple[Finding, ...]
    files: Mapping[str, str] | None = None
    renamed: Mapping[str, str] = {}
    graphs: bool = True
    interfaces: InterfaceDifference | None = None


def add_baseline_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--baseline``, ``--new-only`` and ``--changed``."""
    parser.add_argument(
        "--baseline",
        metavar="REV|FILE|RUN",
        help="compare with a revision of git (where this work tree left it), a JSON or SARIF report, a kept run by "
        "number or `last`, or `auto`: the target of the pull request in a CI, else the default branch of the remote; "
        "only new findings fail the check then, and new findings come first. "
        "One that cannot be read ends with exit code 3",
    )
    parser.add_argument("--new-only", action="store_true", help="show only what the baseline does not have")
    parser.add_argument(
        "--changed",
        nargs="?",
        const="HEAD",
        metavar="REV",
        help="look only at files that differ from a revision (default: HEAD), and show only findings in these; what "
        "needs the other files of a package is left out; `roslens report --changed` shows the run again",
    )


def named_baseline(name: str | None, root: Path, store: Store, environment: Mapping[str, str]) -> str | None:
    """Return the name of a baseline that exists: `auto` becomes the revision that it means.

    Args:
        name: as given; None where none is.
        root: of the workspace.
        store: with the kept runs.
        environment: variables of the process.

    Raises:
        UsageError: there is no such report, run or revision.
    """
    if name is None or Path(name).is_file() or name == LAST:
        return name
    if name.isdigit():
        _refuse_unknown_run(name, [one.id for one in store.runs()])
        return name
    if name.endswith((".json", ".sarif")):
        raise UsageError(f'--baseline "{name}": no such file', expected="a report of `roslens check -o FILE`")
    from roslens.cli.git.git_repository import repository_of
    from roslens.cli.git.merge_target import AUTO, merge_target
    from roslens.cli.git.revision import revision_of

    if name == AUTO:
        return merge_target(repository_of(str(root)), environment)
    revision_of(root, name)
    return name


def _refuse_unknown_run(name: str, runs: Sequence[int]) -> None:
    if int(name) not in runs:
        raise UsageError(
            f'--baseline "{name}": no such run is kept',
            expected=f"one of {', '.join(map(str, sorted(runs)[-10:]))}" if runs else "a run made without --no-store",
            advice="Run `roslens check` on the state to compare with first, or give a revision or a report",
        )


def read_baseline(
    name: str, root: Path, store: Store, current: RunView, analyse: Callable[[Revision], Baseline], *, fresh: bool
) -> Baseline:
    """Return the baseline that a name means.

    Where there is no earlier run yet, the last one is this one if nothing changed since it was kept; else there is
    none, and all that is found is new.

    Args:
        name: a file that exists, else a number or ``last``, else a revision.
        root: of the workspace.
        store: with the kept runs.
        current: the run that is compared.
        analyse: makes the baseline of a revision.
        fresh: whether the run was made just now, as something changed.

    Raises:
        RoslensError: there is none of that name, or it cannot be read.
    """
    if Path(name).is_file():
        return _checked(_of_file(Path(name)), current)
    if name == LAST or name.isdigit():
        return _of_run(name, store, current, fresh=fresh)
    from roslens.cli.git.revision import revision_of

    return analyse(revision_of(root, name))


def _of_run(name: str, store: Store, current: RunView, *, fresh: bool) -> Baseline:
    runs = [one.id for one in store.runs()]
    number = int(name) if name != LAST else next((one for one in runs if one < current.id), None)
    if name == LAST and number is None:
        if fresh:
            return Baseline("nothing, as no earlier run is kept", ())
        number = current.id
    _refuse_unknown_run(str(number), runs)
    view = store.view(number)
    files = {file.path: file.content_hash for _, file in view.files()}
    return Baseline(f"run {number}", tuple(view.findings()), files, graphs=looked_at_graphs(view))


def looked_at_graphs(view: RunView) -> bool:
    """Return whether a run looked at computation graphs: then it knows their rules, whatever these found."""
    return view.header.graphs is not None or any(rule.scope == GRAPH_SCOPE for rule in view.rules())


def _of_file(path: Path) -> Baseline:
    from roslens.intake.bounded_file import read_bounded

    expected = "a report of `roslens check --format json` or --format sarif"
    try:
        document = json.loads(read_bounded(path, MOST_BYTES))
    except (OSError, ValueError, RecursionError) as error:
        raise UsageError(f'--baseline "{path}" cannot be read: {error}', expected=expected) from error
    try:
        if isinstance(document, dict) and str(document.get("schema", "")).startswith("roslens-report/"):
            files = {one["path"]: one["content_hash"] for one in document["files"]}
            graphs = any(rule.get("scope") == GRAPH_SCOPE for rule in document.get("rules", ()))
            return Baseline(str(path), tuple(map(_of_json, document["findings"])), files, graphs=graphs)
        if isinstance(document, dict) and "runs" in document:
            graphs = any(run.get("properties", {}).get(GRAPHS) for run in document["runs"])
            found = tuple(_of_sarif(document))
            return Baseline(str(path), found, graphs=graphs or any(one.rule.startswith("graph.") for one in found))
    except (KeyError, TypeError, AttributeError, ValueError, IndexError) as error:
        raise UsageError(
            f'--baseline "{path}" is not as it was written: {type(error).__name__}: {error}', expected=expected
        ) from error
    raise UsageError(f'--baseline "{path}" is not a report of roslens', expected=expected)


def _of_json(one: Mapping[str, Any]) -> Finding:
    return Finding(
        str(one["rule"]),
        Severity(one["severity"]),
        str(one["message"]),
        str(one["path"]),
        int(one["line"]),
        entity=str(one["entity"]),
        fingerprint=str(one["fingerprint"]),
    )


def _of_sarif(document: Mapping[str, Any]) -> list[Finding]:
    from urllib.parse import unquote

    from roslens.report.run.to_sarif import FINGERPRINT

    levels = {"note": Severity.NOTE, "warning": Severity.WARNING, "error": Severity.ERROR}
    found = []
    for run in document["runs"]:
        if run["tool"]["driver"]["name"] != "roslens":
            continue
        below = str(run.get("automationDetails", {}).get("id", "")).removeprefix("roslens/")
        for result in run["results"]:
            if result.get("suppressions"):
                continue
            place = (result.get("locations") or [{}])[0]
            path = unquote(place.get("physicalLocation", {}).get("artifactLocation", {}).get("uri", ""))
            found.append(
                Finding(
                    str(result["ruleId"]),
                    levels[result["level"]],
                    str(result["message"]["text"]),
                    path.removeprefix(below),
                    entity=_entity(place.get("logicalLocations") or [{}], path.removeprefix(below)),
                    fingerprint=str(result.get("partialFingerprints", {}).get(FINGERPRINT, "")),
                )
            )
    return found


_KINDS = {"type": "class", "function": "function", "module": "package"}


def _entity(places: Sequence[Mapping[str, Any]], path: str) -> str:
    kind = _KINDS.get(str(places[0].get("kind", "")))
    return f"{kind}:{places[0]['fullyQualifiedName']}" if kind else f"file:{path}"


def _checked(baseline: Baseline, current: RunView) -> Baseline:
    """Refuse a baseline of which not one file is in the run.

    Raises:
        UsageError: it is of another workspace.
    """
    there = {file.path for _, file in current.files()}
    before = set(baseline.files) if baseline.files is not None else {one.path for one in baseline.findings if one.path}
    if before and there and not before & there:
        raise UsageError(
            f'--baseline "{baseline.title}" is of another workspace: none of its {len(before)} files is here, such as '
            f'"{min(before)}"',
            expected="a report of the same folder",
            advice="Give the same PATH as when it was made",
        )
    return baseline


def failed(error: RoslensError) -> Failure:
    """Return the failure that stands in the result where there is no baseline; every finding counts then."""
    return Failure("baseline", error.what, error.expected, f"{error.advice or 'Fix it'}; all findings count until then")


def analysed_revision(
    revision: Revision, options: argparse.Namespace, root: Path, configuration: Configuration
) -> Baseline:
    """Analyse the files of a revision as this run was, and return what was found.

    Raises:
        RoslensError: git does not have the files.
    """
    import os
    import time

    from roslens.children.scratch_folder import ScratchFolder
    from roslens.cli.check.analysed import analysed
    from roslens.cli.git.git_tree import write_tree
    from roslens.cli.git.revision import renamed_since
    from roslens.cli.interfaces.states import state_of_tree
    from roslens.cli.terminal.streams import NoProgress
    from roslens.cli.workplace.workplace import CACHE, kept_in, own_folder
    from roslens.source.extract.workspace.interface_state import interface_difference
    from roslens.store.runs import Store

    with ScratchFolder("baseline") as folder:
        place = Path(folder).resolve()
        lacking = write_tree(revision.repository, revision.commit, place)
        if lacking.submodules:
            print(f"roslens: {revision.title} lacks submodule {lacking.submodules[0][0]}", file=sys.stderr)
        paths = [place / Path(one).resolve().relative_to(root) for one in options.paths]
        asked = argparse.Namespace(
            **{**vars(options), "paths": [one for one in paths if one.is_dir()], "no_store": True}
        )
        if not asked.paths:
            return Baseline(revision.title, (), {}, {})
        if not options.no_cache:
            _lend(kept_in(root) / CACHE, own_folder(place) / CACHE)
        with Store.open(None) as store:
            answer = analysed(
                asked,
                place,
                configuration,
                environment=dict(os.environ),
                store=store,
                progress=NoProgress(),
                begun=time.monotonic(),
            )
            view = store.view(answer.run)
            files = {file.path: file.content_hash for _, file in view.files()}
            return Baseline(
                revision.title,
                tuple(view.findings()),
                files,
                renamed_since(revision),
                graphs=looked_at_graphs(view),
                interfaces=interface_difference(
                    state_of_tree(place, configuration.source), state_of_tree(root, configuration.source)
                ),
            )


def _lend(kept: Path, copy: Path) -> None:
    """Copy the cache: what is known of files by their content holds for those of any revision."""
    import sqlite3
    from contextlib import closing, suppress

    if not kept.is_file():
        return
    with (
        suppress(sqlite3.Error, OSError),
        closing(sqlite3.connect(f"file:{kept}?mode=ro", uri=True)) as source,
        closing(sqlite3.connect(copy)) as target,
    ):
        source.backup(target)
