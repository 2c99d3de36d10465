"""Nodes of which no endpoint is known, with the code that is linked into them and that nothing known starts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration, ConfiguredNode, Proof
    from roslens.source.extract.facts.node_facts import Target
    from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts


def with_linked(
    found: Sequence[Configuration], unstarted: Sequence[Configuration], facts: WorkspaceFacts
) -> tuple[Configuration, ...]:
    """Return configurations whose empty nodes name the code that may belong to them.

    A factory of another library may make the objects that a node consists of: then nothing is seen to make them, and
    their endpoints stand among what no known program starts.

    Args:
        found: with the nodes.
        unstarted: what no known program starts.
        facts: of the workspace, which know the sources of programs.
    """
    loose: dict[str, list[ConfiguredNode]] = {}
    for one in unstarted:
        loose.setdefault(one.generation, []).extend(node for node in one.nodes if node.endpoints)
    if not loose:
        return tuple(found)
    return tuple(_linked(one, loose.get(one.generation, []), facts.of(one.generation)) for one in found)


def _linked(one: Configuration, loose: Sequence[ConfiguredNode], facts: WorkspaceFacts) -> Configuration:
    nodes = []
    for node in one.nodes:
        if node.package and facts.has(node.package) and all(end.implicit for end in node.endpoints):
            targets = [each for each in facts.targets(node.package) if node.executable in (each.name, each.entry)]
            node = msgspec.structs.replace(node, linked=tuple(_places(targets, loose)))
        nodes.append(node)
    return msgspec.structs.replace(one, nodes=tuple(nodes))


def _places(targets: Iterable[Target], loose: Sequence[ConfiguredNode]) -> Iterable[Proof]:
    sources = {path for one in targets for path in one.sources}
    return (one.defined for one in loose if one.defined is not None and one.defined.path in sources)
