"""What one run is made of: the workspace and its files, what is asked, and what looks at it besides."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.graphs.graph_scope import GraphScope
from roslens.source.fetch.fetched_set import FetchedSet
from roslens.source.inventory import Inventory
from roslens.source.keys import key_of
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage, Workspace
from roslens.source.workspace.silence import Silence
from roslens.source.workspace.surroundings import Surroundings

if TYPE_CHECKING:
    from roslens.model.finding import RuleInfo
    from roslens.plugins.discovery import Discovered
    from roslens.plugins.outcome import Outcome
    from roslens.source.engines.cluster_ahead import ClusterAhead
    from roslens.source.history.past_revision import PastRevision
    from roslens.source.history.process_stage import Past
    from roslens.source.tools.running.tool_stage import ToolStage
    from roslens.store.configurations import PackedConfiguration


class Clock(msgspec.Struct, frozen=True):
    """The time at which the run began: ``utc`` for readers, ``epoch_s`` to compare with files.

    ``elapsed_s`` tells how many seconds have passed since.
    """

    utc: str
    epoch_s: float
    elapsed_s: Callable[[], float] = lambda: 0.0


class Seen(msgspec.Struct, frozen=True):
    """The workspace as a run found it, all of it, and its files."""

    workspace: Workspace
    inventory: Inventory


def seen_below(
    paths: Sequence[str | Path], workspace: Workspace, inventory: Inventory, packages: Sequence[FoundPackage]
) -> Seen | None:
    """Return what was found; None where not all below the root was looked for packages, or not all are among these."""
    is_below = len(paths) == 1 and os.path.realpath(paths[0]) == os.path.realpath(workspace.root)
    is_all = is_below and packages == workspace.packages
    return Seen(workspace, inventory) if is_all else None


class Sight(msgspec.Struct, frozen=True):
    """What a further look found, the computation graphs that it looked at, and which these are; the run keeps all."""

    outcome: Outcome
    configurations: tuple[PackedConfiguration, ...] = ()
    graphs: GraphScope | None = None


class Beyond(msgspec.Struct, frozen=True):
    """A further look at the workspace as a whole, taken when a run is made, after its packages were measured.

    Attributes:
        key: of what shapes it besides files and settings.
        rules: that its findings may name.
        look: returns what belongs to no package; it is given what the run found, None where that is not all there is.
    """

    key: str
    rules: tuple[RuleInfo, ...]
    look: Callable[[Seen | None], Sight]


def among_changes(beyond: Beyond | None, changed: Sequence[str], everything: str) -> Beyond | None:
    """Return a further look where only changed packages count; None where no package changed.

    What it finds in them depends on all others too, so ``everything``, a key of those, shapes it.
    """
    if beyond is None or not changed:
        return None
    return msgspec.structs.replace(beyond, key=f"{beyond.key} {everything}")


class Run(msgspec.Struct, frozen=True):
    """See :func:`~roslens.source.pipeline.analyse` for what they are."""

    workspace: Workspace
    inventory: Inventory
    settings: SourceSettings
    plugins: Discovered
    units: dict[str, str]
    key: str
    base: Path
    clock: Clock
    jobs: int
    log: Path | None
    programs: bool
    beyond: Beyond | None
    tools: ToolStage | None
    silence: Silence
    past: Past | None
    fetched: FetchedSet
    revision: PastRevision | None
    kept_runs: int | None
    engine: str | ClusterAhead
    left_out: Mapping[str, frozenset[str]] = {}
    around: Mapping[str, Surroundings] = {}
    seen: Seen | None = None

    def key_kept(self, key: str, *, lost: bool = False) -> str:
        """Return the key under which a result is kept: one of its own where it is tried again by the next run.

        Args:
            key: of all that shapes it.
            lost: that a package could not be measured.
        """
        again = lost or (self.tools is not None and self.tools.has_failed)
        return key_of(key, self.clock.epoch_s) if again else key
