"""Nodes of two users on one host: Fast DDS gives them memory that the other may not write, so nothing arrives."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.compare.why.apart import FAST_DDS
from roslens.compare.why.observed import Observed
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.answers.ros_process import RosProcess
from roslens.model.graph import Endpoint, Role

_ROOT = 0
_MOST = 3
_HOW = (
    "run both as one user, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4 for both, which counts unless "
    "ROS_AUTOMATIC_DISCOVERY_RANGE is LOCALHOST"
)


def kept_apart_by_user(ends: Sequence[Endpoint], observed: Observed) -> Step | None:
    """Return which subscriptions of a topic get nothing because they are of another user; None where none is known to.

    A subscription of root may write all memory. Measured with Fast DDS 3.2 of two users on one host: all endpoints are
    listed, and of what one publishes the other receives nothing; the same with ``FASTDDS_BUILTIN_TRANSPORTS=UDPv4``
    where ``ROS_AUTOMATIC_DISCOVERY_RANGE`` is ``LOCALHOST``, and all of it where that is not set.
    """
    of_pid = {one.pid: one for one in observed.processes}
    at = {one.name: (one.host, of_pid[one.pid]) for one in observed.graph.nodes if one.pid in of_pid}
    publishers = list(dict.fromkeys(one.node for one in ends if one.role is Role.PUBLISHER))
    subscribers = list(dict.fromkeys(one.node for one in ends if one.role is Role.SUBSCRIPTION))
    if not publishers or not all(one in at for one in publishers):
        return None
    for name in subscribers:
        if name in at and all(_closed(at[one], at[name], observed) for one in publishers):
            users = ", ".join(str(user) for user in sorted({at[one][1].user for one in publishers}))
            says = f"{name} can receive nothing: it runs as user {at[name][1].user}, and {publishers[0]} as {users}"
            lines = [f"user {at[one][1].user}: {at[one][1].command} (process {at[one][1].pid})"
                     for one in (*publishers[:_MOST], name)]  # fmt: skip
            lines.append("Fast DDS sends through memory in /dev/shm, which users other than its owner may not write")
            return Step(Asks.REACHED, StepState.NOT, says, "live", tuple(lines), _HOW, "ls -ln /dev/shm")
    return None


def _closed(publisher: tuple[str, RosProcess], subscriber: tuple[str, RosProcess], observed: Observed) -> bool:
    (host, sends), (other_host, receives) = publisher, subscriber
    return (
        host == other_host
        and sends.user != receives.user != _ROOT
        and sends.user in observed.closed_memory
        and all(one.rmw in FAST_DDS and _shares_memory(one) for one in (sends, receives))
    )


def _shares_memory(process: RosProcess) -> bool:
    """Return whether it may send through memory: with discovery on this host alone, the middleware always does."""
    return not process.transports or process.discovery == "LOCALHOST"
