"""The quality models that a run judges by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from roslens.judge.quality_model import QualityModel, load_model
from roslens.model.quantity import Quantity


def chosen_models(names: Sequence[str], base: Path, known: Mapping[str, Quantity]) -> tuple[QualityModel, ...]:
    """Load the models called ``names``: built-in names, or paths that start from ``base``.

    Raises:
        DocumentError: a model is wrong or not there.
    """
    return tuple(load_model(model_reference(name, base), known) for name in names)


def model_reference(name: str, base: Path) -> str:
    """Return the path of a model that is a file below ``base``, else the name itself."""
    path = base / name
    return str(path) if path.is_file() else name


def model_text(name: str, base: Path) -> str:
    """Return what tells whether a model changed: the text of its file, or the name of a built-in one."""
    path = base / name
    return path.read_text("utf-8", "replace") if path.is_file() else name
