"""``roslens graph --diff A B``: two revisions, launch files, sets of arguments or documents, one against the other."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.children.scratch_folder import ScratchFolder
from roslens.cli.graph.graph_opened import open_source
from roslens.cli.terminal.boundary import CLEAN, FINDINGS
from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
from roslens.model.configuration import Configuration
from roslens.model.errors import UsageError
from roslens.model.finding import Finding

if TYPE_CHECKING:
    from roslens.cli.git.git_repository import Repository
    from roslens.cli.git.git_tree import Lacking
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.compare.finding_difference import FindingDifference
    from roslens.compare.graph_difference import Difference

NOW = "."
"""Stands for the files as they are, beside a revision."""


class Side(msgspec.Struct, frozen=True):
    """One side of a comparison.

    Attributes:
        title: how it is called.
        configurations: by generation or launch file.
        findings: of all of them; None of a document, which has no source to look for any.
        renamed: files with another path than on the side before, by that one.
    """

    title: str
    configurations: dict[str, Configuration]
    findings: tuple[Finding, ...] | None = ()
    renamed: Mapping[str, str] = {}


def diff(options: argparse.Namespace) -> int:
    """Compare, write what is different and return the exit code: 1 where something is.

    Raises:
        UsageError: a side is nothing that can be compared.
    """
    from roslens.cli.graph.graph_choice import require_nodes
    from roslens.cli.terminal.streams import write_result

    if options.format not in ("text", "markdown", "json"):
        raise UsageError(f"--format {options.format} with --diff", expected="text, markdown or json")
    before, after = _sides(options)
    require_nodes((*before.configurations.values(), *after.configurations.values()), options.node)
    found = differences_of(before, after, options.node, implicit=options.all)
    findings = findings_between(before, after, options.node)
    write_result(_writer(options.format)(found, before.title, after.title, findings), options.output)
    if findings is None and not options.quiet:
        print("roslens: findings are not compared: documents hold no source to look for them", file=sys.stderr)
    return FINDINGS if found or findings else CLEAN


def _writer(form: str) -> Callable[[Sequence[Difference], str, str, FindingDifference | None], str]:
    if form == "json":
        from roslens.report.graph.difference_document import to_difference_json

        return to_difference_json
    from roslens.report.graph.difference_text import to_markdown, to_text

    return to_markdown if form == "markdown" else to_text


def findings_between(before: Side, after: Side, nodes: Sequence[str] = ()) -> FindingDifference | None:
    """Return the new and gone findings about the requested nodes; None if no findings were computed."""
    from roslens.cli.graph.graph_choice import chosen
    from roslens.compare.finding_difference import about, finding_difference

    found: list[tuple[Finding, ...]] = []
    for side in (before, after):
        if side.findings is None:
            return None
        shown = [chosen(one, nodes, implicit=True) for one in side.configurations.values()]
        found.append(tuple(one for part in shown for one in about(side.findings, part)) if nodes else side.findings)
    return finding_difference(found[0], found[1], after.renamed)


def differences_of(
    before: Side, after: Side, nodes: Sequence[str] = (), *, implicit: bool = False
) -> tuple[Difference, ...]:
    """Return what is different between two sides, of the nodes that are asked for."""
    from roslens.cli.graph.graph_choice import chosen
    from roslens.compare.graph_difference import differences

    found: list[Difference] = []
    for name in sorted({*before.configurations, *after.configurations}):
        pair = [side.configurations.get(name, Configuration(name, "")) for side in (before, after)]
        found += differences(*(chosen(one, nodes, implicit=implicit) for one in pair))
    return tuple(found)


def _sides(options: argparse.Namespace) -> tuple[Side, Side]:
    if any(text.endswith(".json") for text in options.diff):
        return _documents(options)
    if options.launch or options.package:
        return _revisions(options)
    if options.arg:
        raise UsageError("--arg with --diff", expected="--launch FILE too, or FILE:arg=value after --diff")
    with open_source(options) as source:
        named = [source.names_launch_file(text.partition(":")[0]) for text in options.diff]
        if all(named):
            first, second = (_launched(source, text) for text in options.diff)
            return first, second
    if any(named):
        raise _two_kinds(*sorted(options.diff, key=lambda text: text == options.diff[named.index(True)]))
    return _revisions(options)


def _documents(options: argparse.Namespace) -> tuple[Side, Side]:
    """Return two sides from files written by ``--format json``."""
    from roslens.report.graph.graph_document import read_graph_json

    if options.launch or options.arg or options.package:
        raise UsageError(
            "--launch, --arg or --package with documents", expected="the revisions to compare, only after --diff"
        )
    sides = []
    for name in options.diff:
        if not name.endswith(".json"):
            raise UsageError(f'"{name}" with a document', expected="two files written by --format json")
    for name in options.diff:
        found = read_graph_json(read_bounded(Path(name), MOST_DOCUMENT_BYTES), name)
        if len({one.generation for one in found}) < len(found):
            raise UsageError(f"{name} has {len(found)} configurations", expected="one of each generation of ROS")
        # Two of one configuration are compared whatever their generation is.
        sides.append({one.generation if len(found) > 1 else "": one for one in found})
    return Side(options.diff[0], sides[0], None), Side(options.diff[1], sides[1], None)


def _launched(source: GraphSource, text: str) -> Side:
    launch, _, rest = text.partition(":")
    pairs = (pair.partition("=") for pair in rest.split(",") if pair)
    # With --arg a colon stands before the sign; it is no part of a name here either.
    arguments = {name.removesuffix(":"): value for name, _, value in pairs}
    return _side(text, source, {"": source.launched(launch, arguments)}, launch, arguments)


def _side(
    title: str,
    source: GraphSource,
    configurations: dict[str, Configuration],
    launch: str = "",
    arguments: Mapping[str, str] | None = None,
) -> Side:
    from roslens.cli.graph.graph_findings import findings_of

    found = [finding for one in configurations.values() for finding in findings_of(source, one, launch, arguments)]
    return Side(title, configurations, tuple(found))


def _revisions(options: argparse.Namespace) -> tuple[Side, Side]:
    from roslens.cli.git.git_renames import renamed_files
    from roslens.cli.git.git_repository import commit_of_revision, repository_of

    repository = repository_of(options.path)
    commits = {name: "" if name == NOW else commit_of_revision(repository, name) for name in options.diff}
    for name, commit in commits.items():
        if not commit and name != NOW:
            raise _unknown(repository, name)
    sides: list[Side] = []
    lacking: list[UsageError] = []
    with _opened(options, repository, commits) as sources:
        for name, source in zip(options.diff, sources, strict=True):
            title = _title(name, commits[name], options)
            try:
                sides.append(_of_revision(title, source, options))
            except UsageError as error:
                # What one side lacks is new on the other.
                lacking.append(error)
                sides.append(Side(title, {}))
                print(f'roslens: in "{name}": {error}', file=sys.stderr)
    if len(lacking) == len(sides):
        raise lacking[-1]
    before, after = (commits[name] for name in options.diff)
    # For files that are in no commit, git would have to run filters that the repository names.
    renamed = renamed_files(repository, before, after) if before and after else {}
    return sides[0], msgspec.structs.replace(sides[1], renamed=renamed)


@contextmanager
def _opened(
    options: argparse.Namespace, repository: Repository, commits: dict[str, str]
) -> Iterator[list[GraphSource]]:
    """Open the workspace as it was at each side's commit."""
    from contextlib import ExitStack

    from roslens.cli.git.git_tree import write_tree

    with ExitStack() as stack:
        sources = []
        for name in options.diff:
            folder = None
            if commits[name]:
                folder = stack.enter_context(ScratchFolder("revision"))
                lacking = write_tree(repository, commits[name], Path(folder))
                if not options.quiet:
                    _tell(name, lacking)
            sources.append(stack.enter_context(open_source(options, folder)))
        yield sources


def _tell(name: str, lacking: Lacking) -> None:
    missing = [path for path in lacking.files if _is_read(path)]
    if missing:
        reported = f'{len(missing)} files of "{name}", {missing[0]} among them'
        print(f"roslens: git does not have {reported}; they are taken as empty", file=sys.stderr)
    for path, commit in lacking.submodules:
        print(
            f'roslens: submodule {path} of "{name}" is missing: its commit {commit[:10]} is not on this machine, and '
            f"its dependents may be reported as different; `git -C {path} fetch origin {commit[:10]}` gets it, after "
            f"`git submodule update --init {path}`",
            file=sys.stderr,
        )


def _is_read(path: str) -> bool:
    from roslens.model.source import Language
    from roslens.source.workspace.languages import language_by_name

    return language_by_name(path) is not Language.OTHER


def _of_revision(title: str, source: GraphSource, options: argparse.Namespace) -> Side:
    from roslens.cli.graph.graph_source import arguments_of

    if not options.launch:
        return _side(title, source, {one.generation: one for one in source.packages(options.package)})
    arguments = arguments_of(options.arg)
    return _side(title, source, {"": source.launched(options.launch, arguments)}, options.launch, arguments)


def _title(name: str, commit: str, options: argparse.Namespace) -> str:
    what = " ".join([options.launch, *options.arg]) if options.launch else ", ".join(options.package)
    revision = (
        "the files as they are" if name == NOW else name if commit.startswith(name) else f"{name} ({commit[:10]})"
    )
    return f"{what} at {revision}" if what else revision


def _two_kinds(other: str, launch: str) -> UsageError:
    return UsageError(
        f'"{launch}" is a launch file and "{other}" is none',
        expected="two launch files, or two revisions",
        advice=f"For one launch file at two revisions: --launch {launch.partition(':')[0]} --diff A B",
    )


def _unknown(repository: Repository, name: str) -> UsageError:
    from roslens.cli.git.git_repository import names_like

    near = names_like(repository, name)
    meant = f"Did you mean {' or '.join(near)}? " if near else ""
    return UsageError(
        f'no revision "{name}" in {repository.root}, and no launch file of that name',
        expected="two revisions (branch, tag, commit, or . for the files as they are), or two launch files",
        advice=f"{meant}`git log --oneline` shows commits; one of a server is there after `git fetch`",
    )
