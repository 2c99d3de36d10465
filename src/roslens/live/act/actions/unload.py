"""``unload``: a component leaves its container."""

from __future__ import annotations

from roslens.live.act.ros import ActionError, Asked, Ros

LIST = "composition_interfaces/srv/ListNodes"
_UNLOAD = "composition_interfaces/srv/UnloadNode"


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the clients.

    Raises:
        ActionError: there are no composition_interfaces.
    """
    container = asked.arguments["container"]
    ros.meet(f"{container}/_container/list_nodes", LIST, {})
    ros.meet(f"{container}/_container/unload_node", _UNLOAD, {"unique_id": 0})


def act(ros: Ros, asked: Asked) -> str:
    """Find the component in its container and take it out.

    Raises:
        ActionError: it is not in there, or the container does not answer or refuses.
    """
    container, timeout_s = asked.arguments["container"], float(asked.arguments["timeout"])
    held = ros.call(f"{container}/_container/list_nodes", LIST, {}, timeout_s)
    names = list(held.get("full_node_names", ()))
    if asked.target not in names:
        shown = ", ".join(names[:10]) or "no component"
        raise ActionError(f"{container} holds {shown}", expected=asked.target)
    number = list(held["unique_ids"])[names.index(asked.target)]
    answer = ros.call(f"{container}/_container/unload_node", _UNLOAD, {"unique_id": int(number)}, timeout_s)
    if not answer.get("success"):
        raise ActionError(f"{container} did not unload it: {answer.get('error_message', '')}", expected="success: True")
    return f"unloaded from {container}"
