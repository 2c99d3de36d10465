"""The facts about the nodes of a workspace from source, from its packages to the facts of all units, through the cache.

find packages -> take inventory -> (nothing changed? what is kept is the answer) -> programs of changed files -> index
-> evaluate units; beside them what builds make, and interfaces. Each part is kept under the hash of all it depends on.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Package
from roslens.source.extract.builds.targets import Build
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import NodeFacts, Target
from roslens.source.extract.workspace.workspace_interfaces import KnownInterface
from roslens.source.extract.workspace.workspace_nodes import all_nodes
from roslens.source.extract.workspace.workspace_parts import LaunchFile, WorkspaceParts
from roslens.source.inventory import Inventory, take_inventory
from roslens.source.known_manifests import KnownManifests
from roslens.source.progress import Progress, Silent
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import Workspace, find_workspace
from roslens.store.cache import Cache


class Extraction(msgspec.Struct, frozen=True):
    """The facts about nodes in the source of a workspace.

    Attributes:
        root: absolute folder that paths start from.
        packages: sorted by path.
        nodes: facts of all units, in order of their files.
        builds: what the build of each package makes, by name; of two packages of one name that of the first.
        interfaces: messages, services and actions, sorted by name.
        launch_files: sorted by path.
        unresolved: what of source and builds could not be evaluated.
        failures: what could not be read at all.
    """

    root: str
    packages: tuple[Package, ...]
    nodes: tuple[NodeFacts, ...]
    builds: dict[str, Build]
    interfaces: tuple[KnownInterface, ...]
    launch_files: tuple[LaunchFile, ...]
    unresolved: tuple[Unresolved, ...] = ()
    failures: tuple[Failure, ...] = ()

    @property
    def targets(self) -> tuple[Target, ...]:
        """What builds make, package by package."""
        return tuple(target for build in self.builds.values() for target in build.targets)


def extract(
    paths: Sequence[str | Path],
    settings: SourceSettings,
    *,
    cache: Cache,
    now_s: float,
    jobs: int = 0,
    progress: Progress | None = None,
) -> Extraction:
    """Return the facts about nodes in the source below ``paths``.

    Args:
        paths: folders to look into.
        settings: everything that shapes the result.
        cache: what earlier runs learned of files.
        now_s: the time, in seconds since 1970.
        jobs: worker processes; 0 means one per processor, 1 none.
        progress: who watches.

    Raises:
        UsageError: a path does not exist or is a file.
    """
    watch = progress or Silent()
    watch.step("Looking for packages", 0)
    manifests = KnownManifests(cache)
    workspace = find_workspace(paths, settings.workspace, read=manifests.read)
    manifests.keep()
    known = cache.stats(now_s=now_s)
    inventory = take_inventory(workspace, settings.workspace, known)
    if inventory.learned:
        cache.put_stats(inventory.learned, now_s=now_s)
    return extract_found(workspace, inventory, settings, cache=cache, jobs=jobs, progress=watch)


def extract_found(
    workspace: Workspace,
    inventory: Inventory,
    settings: SourceSettings,
    *,
    cache: Cache,
    jobs: int = 0,
    progress: Progress | None = None,
) -> Extraction:
    """Return the facts about nodes in the source of packages; see :func:`extract`.

    Code of tests makes no nodes of the workspace, and names in it would stand beside those of the code that they test.
    """
    parts = WorkspaceParts(workspace, inventory, settings, cache=cache, jobs=jobs, progress=progress)
    builds, interfaces = parts.builds, parts.interfaces
    nodes = all_nodes(parts)
    parts.keep()
    return Extraction(
        root=workspace.root,
        packages=parts.packages,
        nodes=nodes.nodes,
        builds=builds.builds,
        interfaces=interfaces.interfaces,
        launch_files=parts.launch_files(),
        unresolved=(
            *nodes.unresolved,
            *nodes.without_endpoint,
            *(one for build in builds.builds.values() for one in build.unresolved),
        ),
        failures=(*workspace.failures, *inventory.failures, *builds.failures, *interfaces.failures, *nodes.failures),
    )
