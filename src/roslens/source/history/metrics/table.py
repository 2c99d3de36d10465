"""The table of process metrics.

A metric is a module with a ``QUANTITY``, the ``COMMANDS`` of git that answer the same, and a pure function: most have
``of_touched(touched)`` for what history has about one entity; where it says ``NEEDS_LINES`` lines must be counted.
"""

from __future__ import annotations

from types import ModuleType

from roslens.model.quantity import Quantity
from roslens.source.history.metrics import (
    age,
    bus_factor,
    change_coupling,
    churn,
    contributors,
    hotspot,
    ownership,
    releases,
    revisions,
    revisions_since_release,
    time_since_last_commit,
)

PROCESS_METRICS: tuple[ModuleType, ...] = (
    revisions,
    contributors,
    age,
    time_since_last_commit,
    churn,
    ownership,
    bus_factor,
    hotspot,
    change_coupling,
    releases,
    revisions_since_release,
)

PROCESS_QUANTITIES: dict[str, Quantity] = {metric.QUANTITY.key: metric.QUANTITY for metric in PROCESS_METRICS}
