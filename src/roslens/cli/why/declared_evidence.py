"""What source says for an answer: the launch file that is meant, and how else an entity could come to run."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from roslens.compare.why.declared import Declared, Elsewhere, ends_of
from roslens.model.configuration import Configuration, ConfiguredArgument

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.why.launch_files import LaunchFile

_MOST_SWITCHES = 12
_TRUTHS = {"true": "false", "false": "true", "True": "False", "False": "True", "1": "0", "0": "1"}


def declared_evidence(options: argparse.Namespace, names: Callable[[Configuration], bool]) -> Declared | None:
    """Return what a workspace says; None where it has no node.

    Args:
        options: of the command line.
        names: whether a configuration has the entity: of several launch files one that has it is taken, and said.

    Raises:
        UsageError: there is no such folder or launch file.
    """
    from roslens.cli.graph.graph_findings import findings_of
    from roslens.cli.graph.graph_opened import open_source
    from roslens.cli.graph.graph_source import arguments_of
    from roslens.cli.why.launch_files import launch_files

    with open_source(options) as source:
        for failure in source.facts.broken:
            print(f"roslens: {failure.what}; {failure.advice}", file=sys.stderr)
        given = arguments_of(options.arg)
        files, failures = launch_files(source)
        built = source.packages(())
        if options.launch:
            title, launch, configuration = options.launch, options.launch, source.launched(options.launch, given)
        elif files:
            title = _best(files, names)
            named = files[title].named
            launch, given = named.launch, {**named.arguments, **given}
            configuration = source.launched(launch, given) if options.arg else files[title].configuration
            _tell(title, len(files), options)
        elif built:
            configuration = max(built, key=names)
            title, launch = configuration.title, ""
        else:
            return None
        elsewhere = [
            *(_switched(source, launch, configuration, given, options.path) if launch else ()),
            *_other_launches(source, files, title, configuration, options.path),
            *(Elsewhere("the workspace builds it, but this does not start it", one)
              for one in built if one.title != configuration.title and one.generation == configuration.generation),
            *(Elsewhere("a library, plug-in or script that no known program starts makes it", one, loose=True)
              for one in source.unstarted(()) if one.generation == configuration.generation),
        ]  # fmt: skip
        declared_name = launch if title not in source.settings.graph.configurations else title
        findings = findings_of(source, configuration, declared_name, given)
        shown = _shown(launch, source, given)
        command = f"roslens graph {options.path}{f' --launch {shown}' if shown else ''}"
        said = f"{title}{_words(given)}"
        return Declared(said, configuration, tuple(elsewhere), tuple(findings), bool(launch), command, failures)


def _words(given: dict[str, str]) -> str:
    return "".join(f" {name}:={value}" for name, value in given.items())


def _shown(launch: str, source: GraphSource, given: dict[str, str]) -> str:
    place = launch.removeprefix(f"{source.root}/")
    return place + "".join(f" --arg {name}:={value}" for name, value in given.items()) if place else ""


def _best(files: dict[str, LaunchFile], names: Callable[[Configuration], bool]) -> str:
    """Return the launch file that has the entity, of several the one that starts most nodes."""
    return max(files, key=lambda name: (names(files[name].configuration), len(files[name].configuration.nodes)))


def _tell(title: str, among: int, options: argparse.Namespace) -> None:
    if among > 1 and not options.quiet:
        print(f"roslens: looked at is {title}, one of {among} launch files; --launch chooses another", file=sys.stderr)


def _switched(
    source: GraphSource, launch: str, configuration: Configuration, given: dict[str, str], path: str
) -> Iterator[Elsewhere]:
    """Yield what the launch file starts where one of its arguments has another value, as far as that adds anything."""
    here = _parts(configuration)
    for argument in configuration.arguments[:_MOST_SWITCHES]:
        for value in _other_values(argument, given):
            other = source.launched(launch, {**given, argument.name: value})
            if _parts(other) - here:
                now = given.get(argument.name, argument.default)
                how = f"{argument.name}:={value} starts it, and {argument.name} is {now or 'not given'}"
                shown = _shown(launch, source, {**given, argument.name: value})
                yield Elsewhere(f"{how} ({argument.proof.place})", other, f"roslens graph {path} --launch {shown}")


def _parts(configuration: Configuration) -> set[tuple[str, str]]:
    ends = {(one.role.value, one.name) for one in ends_of(configuration)}
    return ends | {("node", node.name) for node in configuration.nodes}


def _other_values(argument: ConfiguredArgument, given: dict[str, str]) -> tuple[str, ...]:
    now = given.get(argument.name, argument.default) or ""
    if argument.choices:
        return tuple(one for one in argument.choices if one != now)
    return (_TRUTHS[now],) if now in _TRUTHS else ()


def _other_launches(
    source: GraphSource, files: dict[str, LaunchFile], title: str, configuration: Configuration, path: str
) -> Iterator[Elsewhere]:
    for name, one in files.items():
        other = one.configuration
        if name != title and other.title != configuration.title and other.generation == configuration.generation:
            shown = _shown(one.named.launch, source, one.named.arguments)
            yield Elsewhere(f"{name} starts it", other, f"roslens graph {path} --launch {shown}")
