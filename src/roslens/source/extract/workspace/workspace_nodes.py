"""The nodes that all code of a workspace makes, and what makes endpoints in none of them; through the cache.

It is kept under the hash of all programs and of the entry points that builds name.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.failure import Failure
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts, Target
from roslens.source.extract.workspace.workspace_parts import WorkspaceParts
from roslens.source.keys import key_of

NEVER_CALLED = "this function creates endpoints, but no evaluated code calls it"


class WorkspaceNodes(msgspec.Struct, frozen=True, array_like=True):
    """What the programs of a workspace come to.

    Attributes:
        nodes: facts of all units, in order of their files.
        unresolved: parts of files that were not understood.
        without_endpoint: calls that look as if they made an endpoint, of which nothing came.
        failures: what could not be read or evaluated at all.
        lasting: whether the next run may take it from the cache.
    """

    nodes: tuple[NodeFacts, ...]
    unresolved: tuple[Unresolved, ...]
    without_endpoint: tuple[Unresolved, ...]
    failures: tuple[Failure, ...]
    lasting: bool = True


class WorkspaceMissed(msgspec.Struct, frozen=True, array_like=True):
    """What of code is in no node, see :class:`WorkspaceNodes`; small, so that it is soon read again.

    Attributes:
        missed: parts of files that were not understood, and calls of which no endpoint came.
        never_called: functions that make endpoints and that no unit calls.
        lasting: whether the next run may take it from the cache.
    """

    missed: tuple[Unresolved, ...]
    never_called: tuple[Unresolved, ...]
    lasting: bool = True


def workspace_missed(parts: WorkspaceParts, version: str = "") -> WorkspaceMissed:
    """Return what was not understood of the code of a workspace, and what in it makes endpoints of no unit.

    ``version`` is that of ROS of whose code, where a workspace has code for both.
    """

    def made() -> WorkspaceMissed:
        nodes = workspace_nodes(parts, version)
        alone = (
            Unresolved(f"{one.unit}()", Evidence(one.path, one.line), NEVER_CALLED)
            for one in nodes.nodes
            if one.kind == "function"
        )
        return WorkspaceMissed((*nodes.unresolved, *nodes.without_endpoint), tuple(alone), nodes.lasting)

    return parts.kept("missed", _key(parts, version), WorkspaceMissed, made)


def workspace_nodes(parts: WorkspaceParts, version: str = "") -> WorkspaceNodes:
    """Return the nodes of a workspace; nothing is read or evaluated where the cache knows the answer.

    ``version`` is that of ROS of whose code, where a workspace has code for both.
    """
    key = _key(parts, version)
    return parts.kept("nodes", key, WorkspaceNodes, lambda: _evaluated(parts, _entries(parts), version))


def all_nodes(parts: WorkspaceParts) -> WorkspaceNodes:
    """Return the nodes of a workspace for all versions of ROS that it has code for."""
    found = [workspace_nodes(parts, version) for version in parts.code_versions()]
    if len(found) == 1:
        return found[0]
    nodes = [node for one in found for node in one.nodes]
    return WorkspaceNodes(
        tuple(sorted(nodes, key=lambda node: (node.path, node.line, node.unit))),
        tuple(dict.fromkeys(place for one in found for place in one.unresolved)),
        tuple(dict.fromkeys(place for one in found for place in one.without_endpoint)),
        (*found[0].failures, *(failure for failure in found[1].failures if failure not in found[0].failures)),
        all(one.lasting for one in found),
    )


def _entries(parts: WorkspaceParts) -> list[Target]:
    return [target for build in parts.builds.builds.values() for target in build.targets if target.entry]


def _key(parts: WorkspaceParts, version: str) -> str:
    return key_of(parts.programs_key, sorted({(target.entry, target.sources) for target in _entries(parts)}), version)


def _evaluated(parts: WorkspaceParts, entries: Iterable[Target], version: str) -> WorkspaceNodes:
    from roslens.source.extract.units.isolated_units import units_of
    from roslens.source.extract.workspace.workspace_programs import not_understood

    programs = parts.programs
    parts.watch.step("Evaluating nodes", 0)
    index = parts.index(version)
    units = units_of(index, entries)
    missed = (
        Unresolved(reason, Evidence(path, line), "this part of the file could not be parsed")
        for path, line, reason in not_understood(index.programs)
    )
    placed = (
        msgspec.structs.replace(one, package=parts.owners.get(one.location.path, "") if one.location else "")
        for one in (*programs.failures, *units.failures)
    )
    return WorkspaceNodes(units.facts, tuple(missed), units.without_endpoint, tuple(placed), programs.lasting)
