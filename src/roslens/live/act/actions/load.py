"""``load``: a component comes into a container."""

from __future__ import annotations

from typing import Any

from roslens.live.act.actions.unload import LIST
from roslens.live.act.parameter_value import parameter_fields
from roslens.live.act.ros import ActionError, Asked, Ros

_LOAD = "composition_interfaces/srv/LoadNode"


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the clients.

    Raises:
        ActionError: there are no composition_interfaces, or a parameter has a value that none can have.
    """
    container = asked.arguments["container"]
    ros.meet(f"{container}/_container/list_nodes", LIST, {})
    ros.meet(f"{container}/_container/load_node", _LOAD, _request(asked))


def act(ros: Ros, asked: Asked) -> str:
    """Load it, unless it is there.

    Raises:
        ActionError: it is there already, or the container does not answer or refuses.
    """
    arguments, timeout_s = asked.arguments, float(asked.arguments["timeout"])
    container = arguments["container"]
    if arguments["name"]:
        wanted = f"{arguments['namespace'].rstrip('/')}/{arguments['name']}"
        held = ros.call(f"{container}/_container/list_nodes", LIST, {}, timeout_s).get("full_node_names", ())
        if wanted in held:
            raise ActionError(f"{container} holds {wanted} already", expected="a name that is free")
    answer = ros.call(f"{container}/_container/load_node", _LOAD, _request(asked), timeout_s)
    if not answer.get("success"):
        raise ActionError(f"{container} did not load it: {answer.get('error_message', '')}", expected="success: True")
    return f"loaded {answer.get('full_node_name', arguments['plugin'])} into {container}"


def _request(asked: Asked) -> dict[str, Any]:
    arguments = asked.arguments
    return {
        "package_name": arguments["package"],
        "plugin_name": arguments["plugin"],
        "node_name": arguments["name"],
        "node_namespace": arguments["namespace"],
        "remap_rules": list(arguments["remap"]),
        "parameters": [parameter_fields(name, value) for name, value in arguments["parameters"].items()],
    }
