"""When a host may be to blame for what is wrong on it, and why.

Not because it is busy, but because it is gone, starves who runs there, loses what is sent, or has a wrong clock.
"""

from __future__ import annotations

from collections.abc import Iterable

from roslens.live.standing.standing import Standing
from roslens.live.system.world import World
from roslens.model.entity import EntityId
from roslens.model.verdict import State

STARVED_PERCENT = 20.0
"""A process that wants to run and waits for a processor for more than this share of the time is starved."""
TIMES = frozenset(("latency", "latency_max", "age", "age_max", "clock_offset"))
"""What a clock that is wrong can break."""
_BUSY = frozenset(("cpu", "cpu_core_max", "load"))
_LINE = frozenset(("resent", "network_drops"))
_CLOCK = "clock_offset"


def why_host(standing: Iterable[Standing], who: EntityId, world: World, now: float) -> str:
    """Return why a host may be to blame for what is wrong with ``who``, which runs on it; empty where it is not.

    Args:
        standing: what is wrong with the host.
        who: a node or process.
        world: what is known.
        now: seconds on the monitor's clock.
    """
    for one in sorted(standing, key=lambda one: one.quantity):
        if one.state.state is State.ABSENT or one.quantity == "presence":
            return "is gone"
        if one.quantity.startswith("pressure_"):
            return f"{_words(one)}: what runs there waits"
        if one.quantity in _LINE:
            return f"{_words(one)}: its link loses messages"
        if one.quantity == _CLOCK:
            return f"{_words(one)}: its clock is wrong"
        if one.quantity in _BUSY and (waited := world.waits_for_processor(who, now)) >= STARVED_PERCENT:
            return f"{_words(one)}, and {who.name} waits for a processor {waited:.0f} % of the time"
    return ""


def only_clock(standing: Iterable[Standing]) -> bool:
    """Whether nothing is wrong with a host that could break more than times."""
    reasons = {one.quantity for one in standing}
    return _CLOCK in reasons and not any(
        key == "presence" or key in _LINE or key.startswith("pressure_") for key in reasons
    )


def _words(one: Standing) -> str:
    value = "" if one.state.value is None else f" {one.state.value:.4g}"
    return f"{one.quantity}{value} is {one.state.state.value}"
