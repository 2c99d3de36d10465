"""The pages of a run: what the dashboard needs, brought together from both halves."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.intake.bounded_file import read_bounded

if TYPE_CHECKING:
    from roslens.cli.graph.graph_configurations import Assembled
    from roslens.dashboard.site import Site
    from roslens.store.read import RunView


def site_of(view: RunView, shown: Assembled | None = None, note: str = "", *, counted: bool = True) -> Site:
    """Return the site that shows ``view``: its quantities, the thresholds of every model, its sources.

    Args:
        view: the run.
        shown: configurations whose computation graphs are shown.
        note: what readers of them have to know.
        counted: whether their findings are among those of the run.
    """
    from roslens.dashboard.site import Site
    from roslens.judge.quality.quality_model import builtin_models, load_model, model_name
    from roslens.model.errors import DocumentError

    quantities = {quantity.key: quantity for quantity in view.workspace.quantities}
    models = []
    chosen = {model_name(name) for name in view.header.models}
    for name in (*view.header.models, *(name for name in builtin_models() if name not in chosen)):
        try:
            models.append(load_model(name, quantities))
        except DocumentError:
            # A model that needs a plug-in which did not run does not apply to this run.
            continue
    return Site(
        view,
        quantities=quantities,
        models=tuple(models),
        read_source=source_reader(Path(view.header.root)),
        configurations=shown.configurations if shown else None,
        about=shown.findings if shown else None,
        graph_note=note,
        graphs_counted=counted,
        unstarted=shown.unstarted if shown else (),
    )


def source_reader(root: Path) -> Callable[[str], bytes | None]:
    """Return a function that reads a file below ``root`` by its relative path, or reports that it cannot."""

    def read(path: str) -> bytes | None:
        try:
            resolved = (root / path).resolve()
            if not resolved.is_relative_to(root.resolve()):
                return None
            return read_bounded(resolved)
        except (OSError, ValueError, RuntimeError):
            return None

    return read
