"""``notify``: in the log of ROS, and as a diagnostic."""

from __future__ import annotations

from typing import Any

from roslens.live.act.ros import Asked, Ros

_TOPIC, _TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"
_LEVELS = {"info": 0, "warning": 1, "error": 2}


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the publishers that are asked for.

    Raises:
        ActionError: there are no diagnostic_msgs, or the master does not register it.
    """
    if "rosout" in asked.arguments["to"]:
        ros.ready_to_log()
    if "diagnostics" in asked.arguments["to"]:
        ros.advertise(_TOPIC, _TYPE, _array(asked), latched=False)


def act(ros: Ros, asked: Asked) -> str:
    """Publish the message.

    Raises:
        ActionError: it cannot be published.
    """
    said = []
    arguments = asked.arguments
    if "rosout" in arguments["to"]:
        ros.log(arguments["level"], arguments["text"])
        said.append("on /rosout")
    if "diagnostics" in arguments["to"]:
        ros.publish(_TOPIC, _TYPE, _array(asked), latched=False)
        said.append(f"on {_TOPIC}")
    return f"said {' and '.join(said)}: {arguments['text']}"


def _array(asked: Asked) -> dict[str, Any]:
    arguments = asked.arguments
    reaction = asked.id.rpartition("/")[0] or asked.id
    status = {
        "level": _LEVELS[arguments["level"]],
        "name": f"roslens reaction: {reaction}",
        "message": arguments["text"],
        "values": [{"key": "decision", "value": asked.id}],
    }
    return {"status": [status]}
