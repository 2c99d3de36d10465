"""The computation graph of a stored run: one that it keeps, or read from its files while they are as they were."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import UsageError
from roslens.model.graph import Graph

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration, ConfiguredNode
    from roslens.store.read import RunView

_MOST_NAMED = 8


class RunGraph(msgspec.Struct, frozen=True):
    """What a configuration of a run starts.

    Attributes:
        graph: what is sure to be there.
        source: the run and the configuration in words.
        unsure: nodes whose start is a guess or has an open condition, or whose names are made anew at each start.
    """

    graph: Graph
    source: str
    unsure: tuple[str, ...] = ()


def names_run(text: str) -> bool:
    """Whether a text is the number of a run, perhaps with the name of a configuration: ``3`` or ``3:drive``."""
    return text.partition(":")[0].isdecimal() and not Path(text).exists()


def graph_of_run(text: str, path: str = ".") -> RunGraph:
    """Return the graph of the run that ``text`` names, of the workspace that ``path`` is in.

    Raises:
        UsageError: there is no store, no such configuration or several, or files are not those of the run any more.
        StoreError: there is no such run, or the store cannot be read.
    """
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.workplace.workplace import CACHE, find_folder, open_store
    from roslens.source.settings import SourceSettings

    number, _, wanted = text.partition(":")
    with open_store(path) as store:
        view = store.view(int(number))
        kept = {one.name: one.configuration for one in view.configurations() if not one.configuration.unstarted}
        header = view.header
        from_files = not kept or (
            bool(wanted) and wanted not in kept and bool(header.graphs and header.graphs.left_out)
        )
        if from_files:
            _require_files(view)
    if not from_files:
        name = _only(tuple(kept), wanted, number)
        return _run_graph(number, name, kept[name])
    try:
        settings = msgspec.convert(header.configuration, SourceSettings)
    except msgspec.ValidationError:
        # A run of another version of roslens may have been asked for something else.
        settings = SourceSettings()
    with GraphSource(header.root, settings, "roslens.toml", {}, cache=find_folder(path) / CACHE) as source:
        from roslens.cli.graph.graph_configurations import chosen_configurations

        named = {one.name: one for one in chosen_configurations(source, every=True).named}
        one = named[_only(tuple(named), wanted, number)]
        return _run_graph(number, one.name, source.launched(one.launch, one.arguments))


def _run_graph(number: str, name: str, configuration: Configuration) -> RunGraph:
    graph, unsure = sure_graph(configuration)
    topics = len({end.name for end in graph.endpoints})
    said = f"run {number}, {name} ({len(graph.nodes)} nodes, {topics} topics, services and actions)"
    return RunGraph(graph, said, unsure)


def sure_graph(configuration: Configuration) -> tuple[Graph, tuple[str, ...]]:
    """Return the part of a configuration that is sure to be there, and the names of the nodes that are not."""
    sure = [node for node in configuration.nodes if _is_sure(node)]
    kept = [
        msgspec.structs.replace(
            node, endpoints=tuple(one for one in node.endpoints if one.resolved and one.proof.sure != "possible")
        )
        for node in sure
    ]
    unsure = sorted(
        {node.name for node in configuration.nodes if node.kind != "process"} - {node.name for node in sure}
    )
    return msgspec.structs.replace(configuration, nodes=tuple(kept)).graph(implicit=False), tuple(unsure)


def _is_sure(node: ConfiguredNode) -> bool:
    made_anew = node.anonymous or not node.resolved
    return not (node.kind == "process" or made_anew or node.conditions or node.proof.sure == "possible")


def _only(names: Sequence[str], wanted: str, number: str) -> str:
    found = [name for name in names if name == wanted or not wanted]
    if len(found) == 1:
        return found[0]
    reported = ", ".join(names[:_MOST_NAMED]) + (", …" if len(names) > _MOST_NAMED else "")
    if not names:
        raise UsageError(f"run {number} has no launch file", expected="a workspace with one")
    if not found:
        raise UsageError(f"run {number} has no configuration {wanted!r}", expected=f"one of {reported}")
    raise UsageError(
        f"run {number} has {len(names)} configurations: {reported}",
        expected="one of them",
        advice=f"Choose it: --graph '{number}:{names[0]}'",
    )


def _require_files(view: RunView) -> None:
    """Make sure that files are as they were: the run keeps no graph, so it is read from them."""
    from roslens.cli.workplace.changed_files import and_more, changed_files

    changed = changed_files(view)
    if changed:
        raise UsageError(
            f"{and_more(changed)} changed since run {view.id}",
            expected="files as they were, or a run that keeps its graphs",
            advice="Run `roslens check` and name the new run, or check out what the run was about",
        )
