"""``set_parameter``: of a node in ROS 2, at the parameter server in ROS 1."""

from __future__ import annotations

from typing import Any

from roslens.live.act.ros import ActionError, Asked, Ros

_PLAIN = (bool, int, float, str)


def prepare(_: Ros, asked: Asked) -> None:
    """Look whether the value is one that a parameter can have.

    Raises:
        ActionError: it is none.
    """
    value: Any = asked.arguments["value"]
    alike = isinstance(value, (list, tuple)) and len({type(one) for one in value}) <= 1
    if not (isinstance(value, _PLAIN) or (alike and all(isinstance(one, _PLAIN) for one in value))):
        raise ActionError(
            f"the value {str(value)[:60]!r}", expected="true or false, a number, a text, or a list of one kind"
        )


def act(ros: Ros, asked: Asked) -> str:
    """Set it.

    Raises:
        ActionError: the node refuses it, or does not answer.
    """
    arguments = asked.arguments
    ros.set_parameter(asked.target, arguments["name"], arguments["value"], float(arguments["timeout"]))
    return f"{arguments['name']} of {asked.target} is {arguments['value']!r}"
