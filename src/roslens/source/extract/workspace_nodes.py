"""The nodes that all code of a workspace makes, and what makes endpoints in none of them; through the cache.

It is kept under the hash of all programs and of the entry points that builds name.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.failure import Failure
from roslens.source.extract.launched import Unresolved
from roslens.source.extract.node_facts import Evidence, NodeFacts, Target
from roslens.source.extract.workspace_parts import WorkspaceParts
from roslens.source.keys import key_of

NEVER_CALLED = "this function makes endpoints, but nothing that was followed calls it"


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


def workspace_missed(parts: WorkspaceParts) -> WorkspaceMissed:
    """Return what was not understood of the code of a workspace, and what in it makes endpoints of no unit."""

    def made() -> WorkspaceMissed:
        nodes = workspace_nodes(parts)
        alone = (
            Unresolved(f"{one.unit}()", Evidence(one.path, one.line), NEVER_CALLED)
            for one in nodes.nodes
            if one.kind == "function"
        )
        return WorkspaceMissed((*nodes.unresolved, *nodes.without_endpoint), tuple(alone), nodes.lasting)

    return parts.kept("missed", _key(parts), WorkspaceMissed, made)


def workspace_nodes(parts: WorkspaceParts) -> WorkspaceNodes:
    """Return the nodes of a workspace; nothing is read or evaluated where the cache knows the answer."""
    return parts.kept("nodes", _key(parts), WorkspaceNodes, lambda: _evaluated(parts, _entries(parts)))


def _entries(parts: WorkspaceParts) -> list[Target]:
    return [target for build in parts.builds.builds.values() for target in build.targets if target.entry]


def _key(parts: WorkspaceParts) -> str:
    return key_of(parts.programs_key, sorted({(target.entry, target.sources) for target in _entries(parts)}))


def _evaluated(parts: WorkspaceParts, entries: Iterable[Target]) -> WorkspaceNodes:
    from roslens.source.extract.isolated_units import units_of
    from roslens.source.extract.workspace_programs import not_understood

    programs = parts.programs
    parts.watch.step("Evaluating nodes", 0)
    units = units_of(parts.index, entries)
    missed = (
        Unresolved(reason, Evidence(path, line), "this part of the file was not understood")
        for path, line, reason in not_understood(programs.programs)
    )
    placed = (
        msgspec.structs.replace(one, package=parts.owners.get(one.location.path, "") if one.location else "")
        for one in (*programs.failures, *units.failures)
    )
    return WorkspaceNodes(units.facts, tuple(missed), units.without_endpoint, tuple(placed), programs.lasting)
