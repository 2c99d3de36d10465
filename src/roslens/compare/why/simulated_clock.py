"""Nodes that wait for the time of a simulation which nobody tells: their timers never fire, and their stamps are 0."""

from __future__ import annotations

from collections.abc import Collection

from roslens.compare.why.observed import Observed
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.graph import Role

_CLOCK = "/clock"


def clock_missing(nodes: Collection[str], observed: Observed) -> Step | None:
    """Return that nodes wait for a clock that nobody publishes; None where none does.

    A client library subscribes to the clock where ``use_sim_time`` is set, and only there.
    """
    ends = [one for one in observed.graph.endpoints if one.name == _CLOCK]
    if any(one.role is Role.PUBLISHER for one in ends):
        return None
    waiting = sorted({one.node for one in ends if one.role is Role.SUBSCRIPTION and one.node in nodes})
    if not waiting:
        return None
    verb = "waits" if len(waiting) == 1 else "wait"
    says = f"{', '.join(waiting)} {verb} for simulated time, and nobody publishes {_CLOCK}"
    lines = ("use_sim_time is set, so timers do not fire and stamps are 0",)
    how = f"start what publishes {_CLOCK} (a simulator, or a recording played with --clock), or set use_sim_time false"
    is_ros1 = observed.graph.generation == "ros1"
    command = "rosparam set use_sim_time false" if is_ros1 else f"ros2 param set {waiting[0]} use_sim_time false"
    return Step(Asks.RUNS, StepState.NOT, says, "live", lines, how, command)
