"""``roslens graph --diff A B``: two revisions, launch files, sets of arguments or documents, one against the other."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.boundary import CLEAN, FINDINGS
from roslens.cli.graph_opened import open_source
from roslens.model.configuration import Configuration
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.git_tree import Repository
    from roslens.cli.graph_source import GraphSource
    from roslens.compare.graph_difference import Difference

NOW = "."
"""Stands for the files as they are, beside a revision."""


class Side(msgspec.Struct, frozen=True):
    """One side of a comparison: how it is called, and its configurations by generation or launch file."""

    title: str
    configurations: dict[str, Configuration]


def diff(options: argparse.Namespace) -> int:
    """Compare, write what is different and return the exit code: 1 where something is.

    Raises:
        UsageError: a side is nothing that can be compared.
    """
    from roslens.cli.graph_choice import require_nodes
    from roslens.cli.streams import write_result

    if options.format not in ("text", "markdown", "json"):
        raise UsageError(f"--format {options.format} with --diff", expected="text, markdown or json")
    before, after = _sides(options)
    require_nodes((*before.configurations.values(), *after.configurations.values()), options.node)
    found = differences_of(before, after, options.node, implicit=options.all)
    if options.format == "json":
        text = msgspec.json.format(msgspec.json.encode(found), indent=1).decode() + "\n"
    else:
        from roslens.report.difference_text import to_markdown, to_text

        text = (to_markdown if options.format == "markdown" else to_text)(found, before.title, after.title)
    write_result(text, options.output)
    return FINDINGS if found else CLEAN


def differences_of(
    before: Side, after: Side, nodes: Sequence[str] = (), *, implicit: bool = False
) -> tuple[Difference, ...]:
    """Return what is different between two sides, of the nodes that are asked for."""
    from roslens.cli.graph_choice import chosen
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
    from roslens.report.graph_document import read_graph_json

    if options.launch or options.arg or options.package:
        raise UsageError("--launch, --arg or --package with documents", expected="what is compared after --diff alone")
    sides = []
    for name in options.diff:
        if not name.endswith(".json"):
            raise UsageError(f'"{name}" with a document', expected="two files written by --format json")
    for name in options.diff:
        found = read_graph_json(Path(name).read_bytes(), name)
        if len({one.generation for one in found}) < len(found):
            raise UsageError(f"{name} has {len(found)} configurations", expected="one of each generation of ROS")
        # Two of one configuration are compared whatever their generation is.
        sides.append({one.generation if len(found) > 1 else "": one for one in found})
    return Side(options.diff[0], sides[0]), Side(options.diff[1], sides[1])


def _launched(source: GraphSource, text: str) -> Side:
    launch, _, rest = text.partition(":")
    arguments = dict(pair.partition("=")[::2] for pair in rest.split(",") if pair)
    return Side(text, {"": source.launched(launch, arguments)})


def _revisions(options: argparse.Namespace) -> tuple[Side, Side]:
    from roslens.cli.git_tree import commit_of_revision, repository_of

    repository = repository_of(options.path)
    commits = {name: "" if name == NOW else commit_of_revision(repository, name) for name in options.diff}
    for name, commit in commits.items():
        if not commit and name != NOW:
            raise _unknown(repository, name)
    sides: list[Side] = []
    lacking: list[UsageError] = []
    with _opened(options, repository, commits) as sources:
        for name, source in zip(options.diff, sources, strict=True):
            try:
                configurations = _of_revision(source, options)
            except UsageError as error:
                # What one side lacks is new on the other.
                lacking.append(error)
                configurations = {}
                print(f'roslens: in "{name}": {error}', file=sys.stderr)
            sides.append(Side(_title(name, commits[name], options), configurations))
    if len(lacking) == len(sides):
        raise lacking[-1]
    return sides[0], sides[1]


@contextmanager
def _opened(
    options: argparse.Namespace, repository: Repository, commits: dict[str, str]
) -> Iterator[list[GraphSource]]:
    """Open the workspace as it was at each side's commit."""
    from contextlib import ExitStack

    from roslens.cli.git_tree import write_tree

    with ExitStack() as stack:
        sources = []
        for name in options.diff:
            folder = None
            if commits[name]:
                folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="roslens-revision-"))
                missing = [path for path in write_tree(repository, commits[name], Path(folder)) if _is_read(path)]
                if missing and not options.quiet:
                    told = f'{len(missing)} files of "{name}", {missing[0]} among them'
                    print(f"roslens: git does not have {told}; they are taken as empty", file=sys.stderr)
            sources.append(stack.enter_context(open_source(options, folder)))
        yield sources


def _is_read(path: str) -> bool:
    from roslens.model.source import Language
    from roslens.source.workspace.languages import language_by_name

    return language_by_name(path) is not Language.OTHER


def _of_revision(source: GraphSource, options: argparse.Namespace) -> dict[str, Configuration]:
    from roslens.cli.graph_source import arguments_of

    if not options.launch:
        return {one.generation: one for one in source.packages(options.package)}
    return {"": source.launched(options.launch, arguments_of(options.arg))}


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
    from roslens.cli.git_tree import names_like

    near = names_like(repository, name)
    meant = f"Did you mean {' or '.join(near)}? " if near else ""
    return UsageError(
        f'no revision "{name}" in {repository.root}, and no launch file of that name',
        expected="two revisions (branch, tag, commit, or . for the files as they are), or two launch files",
        advice=f"{meant}`git log --oneline` shows commits; one of a server is there after `git fetch`",
    )
