"""Values of parameters as rcl_interfaces/Parameter has them."""

from __future__ import annotations

from typing import Any

from roslens.live.act.ros import ActionError

_TYPES: dict[type, tuple[int, str]] = {
    bool: (1, "bool"),
    int: (2, "integer"),
    float: (3, "double"),
    str: (4, "string"),
}
_ARRAYS = {bool: 6, int: 7, float: 8, str: 9}


def parameter_fields(name: str, value: Any) -> dict[str, Any]:
    """Return the fields of an rcl_interfaces/Parameter.

    Raises:
        ActionError: no parameter can have the value.
    """
    if isinstance(value, (list, tuple)):
        kinds = {type(one) for one in value}
        if kinds == {int, float}:
            kinds, value = {float}, [float(one) for one in value]
        if len(kinds) == 1 and (kind := kinds.pop()) in _ARRAYS:
            return {"name": name, "value": {"type": _ARRAYS[kind], f"{_TYPES[kind][1]}_array_value": list(value)}}
    elif found := _TYPES.get(type(value)):
        return {"name": name, "value": {"type": found[0], f"{found[1]}_value": value}}
    expected = "true or false, a number, a text, or a list of one kind"
    raise ActionError(f"the parameter {name!r} with {str(value)[:60]!r}", expected=expected)
