"""Which foreign tools a run uses; cheap where it uses none, which is the default."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.model.source import SourceFile
    from roslens.source.settings import SourceSettings
    from roslens.source.tools.running.tool_stage import ToolStage
    from roslens.source.workspace.find import Workspace
    from roslens.store.cache import Cache


def tool_stage(
    settings: SourceSettings,
    workspace: Workspace,
    files: Mapping[str, tuple[SourceFile, ...]],
    cache: Cache,
    *,
    base: Path,
    jobs: int,
    left_out: frozenset[str] = frozenset(),
) -> ToolStage | None:
    """Return the tools that a run uses; None for none.

    ``left_out`` are paths of files that no tool looks at which can look at others alone.

    Raises:
        UsageError: a tool is unknown.
    """
    tools = settings.tools
    if not (tools.use or tools.commands or tools.imports or tools.untrusted or tools.not_used):
        return None
    from roslens.source.tools.running.tool_stage import ToolStage
    from roslens.source.tools.table import chosen_tools

    chosen = chosen_tools(tools.use, settings.disable, (*tools.commands, *tools.untrusted))
    return ToolStage(chosen, settings, workspace, files, cache, base=base, jobs=jobs, left_out=left_out)
