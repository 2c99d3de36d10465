"""The fields of common messages and services."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import msgspec

_TABLE = "messages.toml"
_WHOLE = frozenset({"builtin_interfaces", "std_msgs", "geometry_msgs", "sensor_msgs", "diagnostic_msgs", "std_srvs"})


class Fields(msgspec.Struct, frozen=True):
    """What a message has.

    Attributes:
        types: by the name of the field: ``double``, ``std_msgs/Header``, ``sequence<float>``, ``double[36]`` …
        constants: their names.
    """

    types: Mapping[str, str]
    constants: frozenset[str] = frozenset()


def fields_of(kind: str) -> Fields | None:
    """Return the fields of ``package/Name``, of a service ``package/Name_Request``; None where they are not known."""
    return _fields().get(kind)


@cache
def whole_packages() -> Mapping[str, frozenset[str]]:
    """Return the names of all interfaces of the packages that the table has whole, by ``package/msg`` or ``/srv``."""
    found: dict[str, set[str]] = {}
    for name in _fields():
        package, _, interface = name.partition("/")
        service = interface.removesuffix("_Request")
        if package in _WHOLE and not interface.endswith(("_Request", "_Response")):
            found.setdefault(f"{package}/msg", set()).add(interface)
        elif package in _WHOLE and service != interface:
            found.setdefault(f"{package}/srv", set()).add(service)
    found["sensor_msgs/srv"] = {"SetCameraInfo"}
    found["diagnostic_msgs/srv"] = {"AddDiagnostics", "SelfTest"}
    return {name: frozenset(of) for name, of in found.items()}


@cache
def _fields() -> Mapping[str, Fields]:
    import tomli

    table: dict[str, dict[str, str]] = tomli.loads(Path(__file__).with_name(_TABLE).read_text("utf-8"))
    return {f"{package}/{name}": _read(text) for package, of in table.items() for name, text in of.items()}


def _read(text: str) -> Fields:
    fields, _, constants = text.partition(";")
    pairs = (one.partition(":") for one in fields.split())
    return Fields({name: kind for name, _, kind in pairs}, frozenset(constants.split()))
