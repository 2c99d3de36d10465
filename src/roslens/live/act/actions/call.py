"""``call``: a service."""

from __future__ import annotations

from roslens.live.act.ros import ActionError, Asked, Ros

_LONGEST = 300


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the client.

    Raises:
        ActionError: the type is not known, or a field does not fit.
    """
    told = asked.arguments
    ros.meet(told["service"], told["type"], told["fields"])


def act(ros: Ros, asked: Asked) -> str:
    """Call it, and say what it answered.

    Raises:
        ActionError: nobody answers in time, or the answer says that it did not succeed.
    """
    told = asked.arguments
    answer = ros.call(told["service"], told["type"], told["fields"], float(told["timeout"]))
    shown = ", ".join(f"{key}: {value}" for key, value in answer.items())[:_LONGEST]
    if answer.get("success") is False:
        raise ActionError(f"{told['service']} answered {shown}", expected="success: True")
    return f"{told['service']} answered {shown or 'without fields'}"
