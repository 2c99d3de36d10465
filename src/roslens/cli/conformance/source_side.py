"""A workspace, a launch file or a graph that a run keeps as a side, with all else that it knows."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.compare.conformance.claim import NODE, TOPIC
from roslens.compare.conformance.configured import claims_of, source_side
from roslens.compare.conformance.side import Beside, Origin, Side
from roslens.model.configuration import Configuration
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource


def workspace_side(folder: str, launch: str, options: argparse.Namespace, others: Sequence[Side]) -> Side:
    """Return what a launch file of a workspace comes to.

    Args:
        folder: of the workspace.
        launch: file or declared configuration; of none the one that fits the other sides best is taken, and said.
        options: of the command line.
        others: the other sides.

    Raises:
        UsageError: there is no such folder or launch file.
    """
    from roslens.cli.graph.graph_configurations import largest, named_configurations
    from roslens.cli.graph.graph_opened import open_source
    from roslens.cli.graph.graph_source import arguments_of

    given = argparse.Namespace(
        path=folder, config=options.config, jobs=options.jobs, no_cache=options.no_cache, verbose=options.verbose
    )
    with open_source(given) as source:
        _tell_broken(source)
        named = largest(source, named_configurations(source))
        made = {one.name: source.launched(one.launch, one.arguments) for one in named}
        built = source.packages(())
        if launch:
            chosen = source.launched(launch, arguments_of(options.arg))
            title = chosen.title
        elif made:
            title = best(made, others, options)
            chosen = made[title]
        elif built:
            chosen = fitting(built, others)
            title = chosen.title
        else:
            raise UsageError(f'"{folder}" has no node', expected="a workspace with packages that make nodes")
        rest = {name: one for name, one in made.items() if one is not chosen and one.title != chosen.title}
        return source_side(chosen, title, beside(chosen, rest, built, source.unstarted(())))


def stored_side(word: str, options: argparse.Namespace, others: Sequence[Side]) -> Side:
    """Return a graph that a run keeps: ``3:drive.launch.xml``, or of a run alone the one that fits best.

    Raises:
        UsageError: there is no store, no such configuration, or the run keeps no graph.
        StoreError: there is no such run.
    """
    from roslens.cli.workplace.workplace import open_store

    number, _, wanted = word.partition(":")
    with open_store(options.workspace) as store:
        view = store.view(int(number) if number.isdecimal() else None)
        every = view.configurations()
        run = view.id
    kept = {one.name: one.configuration for one in every if not one.configuration.unstarted}
    loose = tuple(one.configuration for one in every if one.configuration.unstarted)
    if not kept:
        raise UsageError(
            f"run {run} keeps no graph",
            expected="a run of `roslens check` without --no-graph",
            advice="Or name the workspace",
        )
    if wanted and wanted not in kept:
        raise UsageError(f"run {run} has no configuration {wanted!r}", expected=f"one of {', '.join(kept)}")
    name = wanted or best(kept, others, options)
    rest = {other: one for other, one in kept.items() if other != name}
    return source_side(kept[name], f"run {run}, {name}", beside(kept[name], rest, (), loose))


def document_side(path: str, options: argparse.Namespace, others: Sequence[Side]) -> Side:
    """Return the side of a file that ``roslens graph --format json`` wrote.

    Raises:
        DocumentError: it is none.
        UsageError: it holds no configuration.
    """
    from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
    from roslens.report.graph.graph_document import read_graph_json

    every = read_graph_json(read_bounded(Path(path), MOST_DOCUMENT_BYTES), path)
    kept = {one.title: one for one in every if not one.unstarted}
    if not kept:
        raise UsageError(f'"{path}" has no configuration', expected="a file with at least one")
    name = best(kept, others, options)
    rest = {other: one for other, one in kept.items() if other != name}
    loose = tuple(one for one in every if one.unstarted)
    return source_side(kept[name], f"{Path(path).name}, {name}", beside(kept[name], rest, (), loose))


def best(found: Mapping[str, Configuration], others: Sequence[Side], options: argparse.Namespace) -> str:
    """Return the name of the configuration that has most nodes and topics of the other sides, and report it."""
    names = [*found]
    if len(names) == 1:
        return names[0]
    there = {one.key for side in others for one in side.claims if one.kind in (NODE, TOPIC)}
    shares: dict[str, tuple[int, int]] = {}
    for name, one in found.items():
        claims = {claim.key for claim in claims_of(one) if claim.kind in (NODE, TOPIC) and claim.resolved}
        shares[name] = len(claims & there), -len(claims - there) if claims & there else len(claims)
    # The first of several that fit alike: the order is that of the workspace.
    chosen = max(names, key=lambda name: shares[name])
    if not options.quiet:
        print(
            f"roslens: compared is {chosen}, which fits best of {len(names)} configurations; --launch chooses another",
            file=sys.stderr,
        )
    return chosen


def fitting(found: Sequence[Configuration], others: Sequence[Side]) -> Configuration:
    """Return the configuration of the generation that the other sides have."""
    wanted = {one.generation for one in others}
    return next((one for one in found if one.generation in wanted), found[0])


def beside(
    chosen: Configuration,
    launched: Mapping[str, Configuration],
    built: Sequence[Configuration],
    loose: Sequence[Configuration],
) -> tuple[Beside, ...]:
    """Return what else a workspace has of the same generation, which explains what the chosen one does not."""
    of = {Origin.OTHER_LAUNCH: launched.items(), Origin.NOT_LAUNCHED: ((one.title, one) for one in built)}
    found = [
        Beside(origin, title, claims_of(one))
        for origin, several in of.items()
        for title, one in several
        if one.generation == chosen.generation
    ]
    found += [
        Beside(Origin.UNSTARTED, one.title, claims_of(one)) for one in loose if one.generation == chosen.generation
    ]
    return tuple(found)


def _tell_broken(source: GraphSource) -> None:
    for failure in source.facts.broken:
        print(f"roslens: {failure.what}; {failure.advice}", file=sys.stderr)
