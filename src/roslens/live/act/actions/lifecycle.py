"""``lifecycle``: a managed node of ROS 2 is taken to another state."""

from __future__ import annotations

from typing import Any

from roslens.live.act.ros import ActionError, Asked, Ros

_TYPE, _STATE = "lifecycle_msgs/srv/ChangeState", "lifecycle_msgs/srv/GetState"
_TRANSITIONS = {"configure": 1, "cleanup": 2, "activate": 3, "deactivate": 4}
_SHUTDOWN_FROM = {"unconfigured": 5, "inactive": 6, "active": 7}
"""A managed node has one transition of this name for each state."""


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the client, where the target is known already.

    Raises:
        ActionError: there are no lifecycle_msgs, or the target has no name of a node.
    """
    if "{" not in asked.target:
        ros.meet(f"{asked.target}/change_state", _TYPE, _fields(1))


def act(ros: Ros, asked: Asked) -> str:
    """Ask for the transition.

    Raises:
        ActionError: the node does not answer, or does not do it.
    """
    transition, timeout_s = asked.arguments["transition"], float(asked.arguments["timeout"])
    state = ros.call(f"{asked.target}/get_state", _STATE, {}, timeout_s).get("current_state", {}).get("label", "")
    number = _TRANSITIONS.get(transition) or _SHUTDOWN_FROM.get(state)
    if number is None:
        raise ActionError(f"{asked.target} is {state!r}", expected=f"a state that `{transition}` begins in")
    answer = ros.call(f"{asked.target}/change_state", _TYPE, _fields(number), timeout_s)
    if not answer.get("success"):
        raise ActionError(f"{asked.target} is {state!r} and did not {transition}", expected="success: True")
    return f"{asked.target} was {state} and did {transition}"


def _fields(number: int) -> dict[str, Any]:
    return {"transition": {"id": number}}
