"""The computation graph of a stored run: what a configuration of its workspace starts, its files being as they were."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import UsageError
from roslens.model.graph import Graph

if TYPE_CHECKING:
    from roslens.cli.graph_configurations import Named
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
    from roslens.cli.graph_source import GraphSource
    from roslens.cli.workplace import CACHE, find_folder, open_store
    from roslens.source.settings import SourceSettings

    number, _, wanted = text.partition(":")
    with open_store(path) as store:
        view = store.view(int(number))
        _require_files(view)
        header = view.header
    try:
        settings = msgspec.convert(header.configuration, SourceSettings)
    except msgspec.ValidationError:
        # A run of another version of roslens may have been asked for something else.
        settings = SourceSettings()
    with GraphSource(header.root, settings, "roslens.toml", {}, cache=find_folder(path) / CACHE) as source:
        from roslens.cli.graph_configurations import named_configurations

        one = _only(named_configurations(source), wanted, number)
        graph, unsure = sure_graph(source.launched(one.launch, one.arguments))
    topics = len({end.name for end in graph.endpoints})
    said = f"run {number}, {one.name} ({len(graph.nodes)} nodes, {topics} topics, services and actions)"
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


def _only(named: tuple[Named, ...], wanted: str, number: str) -> Named:
    found = [one for one in named if one.name == wanted or not wanted]
    if len(found) == 1:
        return found[0]
    names = ", ".join(one.name for one in named[:_MOST_NAMED]) + (", …" if len(named) > _MOST_NAMED else "")
    if not named:
        raise UsageError(f"run {number} has no launch file", expected="a workspace with one")
    if not found:
        raise UsageError(f"run {number} has no configuration {wanted!r}", expected=f"one of {names}")
    raise UsageError(
        f"run {number} has {len(named)} configurations: {names}",
        expected="one of them",
        advice=f"Choose it: --graph '{number}:{named[0].name}'",
    )


def _require_files(view: RunView) -> None:
    """Make sure that files are as they were: graphs are read from files, not kept with runs."""
    from roslens.source.keys import content_hash

    root = Path(view.header.root)
    changed = []
    for _, file in view.files():
        try:
            same = not file.content_hash or content_hash((root / file.path).read_bytes()) == file.content_hash
        except OSError:
            same = False
        if not same:
            changed.append(file.path)
    if changed:
        more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
        raise UsageError(
            f"{changed[0]}{more} changed since run {view.id}",
            expected="files as they were",
            advice="Run `roslens check` and name the new run, or check out what the run was about",
        )
