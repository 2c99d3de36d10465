"""Values that something unknown may change: what starts a node may set more of its parameters than could be read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.model.configuration import ConfiguredNode, Unresolved


def doubted(nodes: Iterable[ConfiguredNode], unresolved: Iterable[Unresolved]) -> Iterator[ConfiguredNode]:
    """Yield nodes with their parameters as uncertain where a part of what starts them is unknown.

    Args:
        nodes: of a configuration.
        unresolved: what of it could not be evaluated: a file of parameters whose name is unknown is reported where the
            node is started.
    """
    unknown = {(one.proof.path, one.proof.line) for one in unresolved}
    for node in nodes:
        if not node.parameters or (node.proof.path, node.proof.line) not in unknown:
            yield node
            continue
        parameters = tuple(msgspec.structs.replace(one, uncertain=True) for one in node.parameters)
        yield msgspec.structs.replace(node, parameters=parameters)
