"""Files of parameters that have none for the node they are given to (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.source.extract.facts.launched import Launch, Launched, Setting
from roslens.source.extract.facts.resolve_name import node_pattern_matches
from roslens.source.extract.parameters.assemble_proof import launch_proof
from roslens.source.rules.graph.surroundings import Ignored


def ignored_files(configuration: Configuration, launch: Launch) -> Iterator[Ignored]:
    """Yield each file, with the node that ignores it.

    A file that several nodes are given, and that is for one of those started at the same place, is for this one.

    Args:
        configuration: with the resolved names of nodes.
        launch: that it was assembled from, which says what nodes are given.
    """
    by_place: dict[str, list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        by_place.setdefault(node.proof.place, []).append(node)
    for launched in launch.nodes:
        proof = launch_proof(launched.evidence)
        nodes = by_place.get(proof.place, [])
        # What a container is given holds for all nodes of its process.
        names = {node.name for node in nodes}
        nodes = [*nodes, *(node for node in configuration.nodes if node.container in names)]
        if not _is_known_who(nodes, configuration):
            continue
        for settings in _keyed(launched).values():
            keys = tuple(dict.fromkeys(one.node for one in settings))
            # A name in a file may have a part that is not known either.
            if any("{" in key or node_pattern_matches(key, node.name) for key in keys for node in nodes):
                continue
            first = min(settings, key=lambda one: one.evidence)
            held = list(dict.fromkeys(node.name for node in nodes if node.container not in names))
            yield Ignored(held[0], launch_proof(first.evidence), keys, proof, tuple(held[1:]))


def _is_known_who(nodes: Sequence[ConfiguredNode], configuration: Configuration) -> bool:
    """Whether it is known which nodes are started at a place, the first of them in the launch file itself."""
    if not nodes or not all(node.resolved and node.proof.sure == "certain" for node in nodes):
        return False
    # What a container is given may be for components that others load: no launch file that was read says which.
    alone = len(nodes) == 1 or any(one.opens for one in configuration.unresolved)
    return nodes[0].kind != "container" or not alone


def _keyed(launched: Launched) -> Mapping[str, Sequence[Setting]]:
    """Return the settings that are keyed to nodes, by file."""
    found: dict[str, list[Setting]] = {}
    for one in launched.settings:
        if one.node:
            found.setdefault(one.evidence.path, []).append(one)
    return found
