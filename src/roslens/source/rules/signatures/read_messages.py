"""The fields of common messages and services."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import msgspec

_TABLE = "messages.toml"


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
def _fields() -> Mapping[str, Fields]:
    import tomli

    table: dict[str, dict[str, str]] = tomli.loads(Path(__file__).with_name(_TABLE).read_text("utf-8"))
    return {f"{package}/{name}": _read(text) for package, of in table.items() for name, text in of.items()}


def _read(text: str) -> Fields:
    fields, _, constants = text.partition(";")
    pairs = (one.partition(":") for one in fields.split())
    return Fields({name: kind for name, _, kind in pairs}, frozenset(constants.split()))
