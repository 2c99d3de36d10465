"""What was read of a host, process or node at one instant."""

from __future__ import annotations

import msgspec

from roslens.model.entity import EntityId
from roslens.model.traffic.tally import Observer


class Sample(msgspec.Struct, frozen=True, array_like=True):
    """Values of signals of one entity at an instant.

    A signal that could not be read has no value; 0 means that 0 was read.

    Attributes:
        entity: what was sampled.
        time: seconds on the clock of the monitor.
        values: by key of the signal, in its unit.
        observer: how it was observed.
    """

    entity: EntityId
    time: float
    values: dict[str, float]
    observer: Observer = Observer.AGENT
