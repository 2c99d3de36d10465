"""The quality models that a run judges by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import roslens.judge.quality
from roslens.intake.is_there import is_file
from roslens.model.errors import DocumentError
from roslens.model.quantity import Quantity

if TYPE_CHECKING:
    from roslens.judge.quality.quality_model import QualityModel


def chosen_models(names: Sequence[str], base: Path, known: Mapping[str, Quantity]) -> tuple[QualityModel, ...]:
    """Load the models called ``names``: built-in names, or paths that start from ``base``.

    Raises:
        DocumentError: a model is wrong or not there, or two call themselves the same.
    """
    from roslens.judge.quality.quality_model import load_model

    models: dict[str, QualityModel] = {}
    for name in names:
        model = load_model(name, known, base=base)
        if model.name in models:
            raise DocumentError(
                f"two quality models are called {model.name!r}",
                where=name,
                expected="a name of its own for each",
                advice="Change `name` in one of them",
            )
        models[model.name] = model
    return tuple(models.values())


def model_key(name: str, base: Path, known: Mapping[str, Quantity]) -> object:
    """Return what tells whether a model changed: its constraints, or the name of a built-in one.

    The file alone would not do: it may extend others.

    Raises:
        DocumentError: the model is wrong or not there.
    """
    from roslens.judge.quality.quality_model import load_model, model_name

    if is_file(Path(roslens.judge.quality.__path__[0]) / "models" / f"{model_name(name)}.yaml"):
        return name

    return load_model(name, known, base=base)
