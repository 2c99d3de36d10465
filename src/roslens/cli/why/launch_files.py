"""The launch files of a workspace, each with what it comes to; those that cannot be read are named, and left out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.graph.graph_configurations import Named, chosen_configurations, largest, named_configurations
from roslens.model.configuration import Configuration
from roslens.model.errors import RoslensError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource


class LaunchFile(msgspec.Struct, frozen=True):
    """A launch file with its arguments, under the name that it is shown by, and what it comes to."""

    named: Named
    configuration: Configuration


def launch_files(source: GraphSource) -> tuple[dict[str, LaunchFile], tuple[str, ...]]:
    """Return the launch files to look at by name, and why others could not be, a sentence each.

    Where none that ``roslens.toml`` names is there, those of the packages are looked at.
    """
    failures: list[str] = []
    found = _there(source, named_configurations(source), failures)
    if not found:
        found = _there(source, chosen_configurations(source, every=True).named, failures)
    files: dict[str, LaunchFile] = {}
    for one in largest(source, found):
        try:
            files[one.name] = LaunchFile(one, source.launched(one.launch, one.arguments))
        except RoslensError as error:
            failures.append(f'configuration "{one.name}": {error}')
    return files, tuple(dict.fromkeys(failures))


def _there(source: GraphSource, named: Sequence[Named], failures: list[str]) -> list[Named]:
    """Return those whose file is there, and note why the others are not looked at."""
    found = []
    for one in named:
        try:
            there = source.names_launch_file(one.launch)
        except RoslensError as error:
            failures.append(f'configuration "{one.name}": {error}')
            continue
        if there:
            found.append(one)
        else:
            failures.append(f'configuration "{one.name}": {source.no_launch_file(one.launch)}')
    return found
