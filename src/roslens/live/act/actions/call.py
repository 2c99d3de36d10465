"""``call``: a service."""

from __future__ import annotations

from roslens.live.act.ros import ActionError, Asked, Ros

_LONGEST = 300


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the client.

    Raises:
        ActionError: the type is not known, or a field does not fit.
    """
    arguments = asked.arguments
    ros.meet(arguments["service"], arguments["type"], arguments["fields"])


def act(ros: Ros, asked: Asked) -> str:
    """Call it, and return a description of the response.

    Raises:
        ActionError: nobody answers in time, or the answer says that it did not succeed.
    """
    arguments = asked.arguments
    answer = ros.call(arguments["service"], arguments["type"], arguments["fields"], float(arguments["timeout"]))
    shown = ", ".join(f"{key}: {value}" for key, value in answer.items())[:_LONGEST]
    if answer.get("success") is False:
        raise ActionError(f"{arguments['service']} answered {shown}", expected="success: True")
    return f"{arguments['service']} answered {shown or 'without fields'}"
