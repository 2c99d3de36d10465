"""Arguments given with a launch file that it does not take as they are: reported beside its graph."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration


def wrong_arguments(configuration: Configuration, given: Mapping[str, str]) -> Iterator[str]:
    """Yield a line for each argument that is missing, that the launch file does not declare, or has no valid value.

    Args:
        configuration: what the launch file comes to.
        given: arguments by name, those of a configuration of ``roslens.toml`` among them.
    """
    from roslens.source.rules.graph.argument import found
    from roslens.source.rules.graph.surroundings import Surroundings

    for one in found(configuration, Surroundings(given=dict(given), started=True)):
        yield f"{one.path}:{one.line}: {one.message}"
