"""Graphs that were recorded, and what source said of them, as files beside the tests."""

from __future__ import annotations

from pathlib import Path

import msgspec

from accuracy.facts import Fact
from accuracy.system import HERE, System
from roslens.model.graph import Graph

RECORDED = HERE / "recorded"


def kept_graph(system: System) -> Graph | None:
    """Return the graph that was recorded; None where there is none."""
    path = _path(system, "live")
    return msgspec.json.decode(path.read_bytes(), type=Graph) if path.exists() else None


def kept_facts(system: System) -> tuple[Fact, ...]:
    """Return what source said when it was last there."""
    return msgspec.json.decode(_path(system, "source").read_bytes(), type=tuple[Fact, ...])


def keep(system: System, graph: Graph | None, told: tuple[Fact, ...]) -> None:
    """Write both, one line an entry, so that a change of either is seen."""
    RECORDED.mkdir(exist_ok=True)
    if graph is not None:
        _path(system, "live").write_bytes(_lines(graph))
    _path(system, "source").write_bytes(_lines(told))


def _lines(value: object) -> bytes:
    return msgspec.json.format(msgspec.json.encode(value, order="sorted"), indent=1) + b"\n"


def _path(system: System, what: str) -> Path:
    return RECORDED / f"{system.name}.{what}.json"
