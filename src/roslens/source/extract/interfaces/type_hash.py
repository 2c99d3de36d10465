"""The type hash of a ROS 2 type (``RIHS01_…``), by REP-2011 and REP-2016: it tells types of one name apart.

It is the SHA-256 of the type's description as JSON: its fields with the numbers of their types as in
``type_description_interfaces/msg/FieldType``, then the descriptions of all types it refers to, sorted by name.
Defaults, constants and comments do not count.

rosidl derives ``X_Request``, ``X_Response`` and ``X_Event`` of a service; ``X_Goal``, ``X_Result``, ``X_Feedback``,
``X_FeedbackMessage`` and the services ``X_SendGoal`` and ``X_GetResult`` of an action. They live beside the interface:
``example_interfaces/action/Fibonacci_Goal``. This module says what ``rosidl_generator_type_description`` says.
"""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any

from roslens.source.extract.interfaces.interface import (
    Checksum,
    FieldType,
    Interface,
    InterfaceField,
    Lookup,
    Message,
    unknown_field_type,
)

_NUMBERS = {"nested": 1, "int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8,
            "uint64": 9, "float32": 10, "float64": 11, "char": 3, "bool": 15, "byte": 16, "string": 17, "wstring": 18,
            "string<=": 21, "wstring<=": 22}  # fmt: skip
"""``char`` is an unsigned number of 8 bits in ``.msg`` files, not the character of IDL."""
_ARRAYS = {"": 0, "fixed": 48, "bounded": 96, "unbounded": 144}
_MISREAD = _NUMBERS["wstring<="] + _ARRAYS["unbounded"]
"""An unbounded array of bounded wide strings: rosidl 4.9 takes the bound of the string for one of the array."""
_DEEPEST = 100
_Description = dict[str, Any]
_Reference = tuple[str, str, str]
"""Name of a field, of the array it is, and full name of its type."""


def type_hash(interface: Interface, lookup: Lookup) -> Checksum:
    """Return the hash of a message, service or action of ROS 2.

    Args:
        interface: what to hash.
        lookup: finds the messages of its fields, also those that rosidl adds to services and actions:
            ``service_msgs/msg/ServiceEventInfo``, ``unique_identifier_msgs/msg/UUID``, ``builtin_interfaces/msg/Time``.
    """
    return type_hashes(interface, lookup)[interface.full_name]


def type_hashes(interface: Interface, lookup: Lookup) -> dict[str, Checksum]:
    """Return the hashes of ``interface`` and of all that it consists of, by full name."""
    descriptions = _described(interface)
    if not interface.complete:
        reason = f"the file of {interface.full_name} could not be parsed completely"
        return {name: Checksum(unknown=reason) for name in descriptions}
    if interface.generation != 2:
        reason = f"{interface.full_name} is an interface of ROS {interface.generation}"
        return {name: Checksum(unknown=reason) for name in descriptions}
    known = _Known(lookup, descriptions)
    return {name: known.hash_of(name) for name in descriptions}


class _Known:
    def __init__(self, lookup: Lookup, descriptions: dict[str, _Description]) -> None:
        self._lookup = lookup
        self._descriptions = descriptions.copy()
        self._references: dict[str, frozenset[str] | str] = {}

    def hash_of(self, name: str) -> Checksum:
        found = self._below(name, ())
        match found:
            case str():
                return Checksum(unknown=found)
        described = {
            "type_description": self._descriptions[name],
            "referenced_type_descriptions": [self._descriptions[one] for one in sorted(found)],
        }
        text = json.dumps(described, separators=(", ", ": "))
        return Checksum(f"RIHS01_{sha256(text.encode()).hexdigest()}")

    def _below(self, name: str, above: tuple[str, ...]) -> frozenset[str] | str:
        """Return all types that ``name`` refers to, or why they cannot be determined."""
        if name in above:
            return f"{name} contains itself"
        if len(above) > _DEEPEST:
            return f"more than {_DEEPEST} levels of nested messages, down to {name}"
        if name in self._references:
            return self._references[name]
        if any(field["type"]["type_id"] == _MISREAD for field in self._descriptions[name]["fields"]):
            return f"versions of rosidl do not agree on an unbounded array of bounded wide strings, as {name} has"
        found: set[str] = set()
        for field in self._descriptions[name]["fields"]:
            nested = field["type"]["nested_type_name"]
            if not nested:
                continue
            reason = self._find(name, field["name"], nested)
            if reason:
                return reason
            below = self._below(nested, (*above, name))
            match below:
                case str():
                    return below
            found |= {nested, *below}
        self._references[name] = frozenset(found)
        return self._references[name]

    def _find(self, owner: str, field: str, name: str) -> str:
        """Describe a type; return why it cannot be."""
        if name in self._descriptions:
            return ""
        interface = self._lookup(name)
        if interface is None:
            package, _, short = name.partition("/msg/")
            return unknown_field_type(owner, InterfaceField(field, FieldType(short, package))).unknown
        if not interface.complete:
            return f"the file of {name} could not be parsed completely"
        if interface.generation != 2 or interface.kind != "msg":
            return f"{name} is not a message of ROS 2"
        self._descriptions.update(_described(interface))
        return ""


def _described(interface: Interface) -> dict[str, _Description]:
    """Return the descriptions of an interface and of what rosidl derives from it, by full name."""
    name = interface.full_name
    if interface.kind == "msg":
        return _message(name, interface.parts[0])
    if interface.kind == "srv":
        return _service(
            name, _message(f"{name}_Request", interface.parts[0]), _message(f"{name}_Response", interface.parts[1])
        )
    goal, result, feedback = interface.parts
    identity = ("goal_id", "", "unique_identifier_msgs/msg/UUID")
    send, get = f"{name}_SendGoal", f"{name}_GetResult"
    accepted, status = _field("accepted", FieldType("bool")), _field("status", FieldType("int8"))
    stamp = ("stamp", "", "builtin_interfaces/msg/Time")
    return {
        **_referring(
            name,
            ("goal", "", f"{name}_Goal"),
            ("result", "", f"{name}_Result"),
            ("feedback", "", f"{name}_Feedback"),
            ("send_goal_service", "", send),
            ("get_result_service", "", get),
            ("feedback_message", "", f"{name}_FeedbackMessage"),
        ),
        **_message(f"{name}_Goal", goal),
        **_message(f"{name}_Result", result),
        **_message(f"{name}_Feedback", feedback),
        **_service(
            send,
            _referring(f"{send}_Request", identity, ("goal", "", f"{name}_Goal")),
            _referring(f"{send}_Response", accepted, stamp),
        ),
        **_service(
            get,
            _referring(f"{get}_Request", identity),
            _referring(f"{get}_Response", status, ("result", "", f"{name}_Result")),
        ),
        **_referring(f"{name}_FeedbackMessage", identity, ("feedback", "", f"{name}_Feedback")),
    }


def _service(name: str, request: dict[str, _Description], response: dict[str, _Description]) -> dict[str, _Description]:
    event = _referring(
        f"{name}_Event",
        ("info", "", "service_msgs/msg/ServiceEventInfo"),
        ("request", "bounded", f"{name}_Request"),
        ("response", "bounded", f"{name}_Response"),
    )
    parts = _referring(
        name,
        ("request_message", "", f"{name}_Request"),
        ("response_message", "", f"{name}_Response"),
        ("event_message", "", f"{name}_Event"),
    )
    return {**parts, **request, **response, **event}


def _message(name: str, message: Message) -> dict[str, _Description]:
    fields = [_field(field.name, field.type) for field in message.fields]
    empty = [_field("structure_needs_at_least_one_member", FieldType("uint8"))]
    return {name: {"type_name": name, "fields": fields or empty}}


def _referring(name: str, *fields: _Reference | _Description) -> dict[str, _Description]:
    """Describe a type that is derived; what is a tuple refers to another one, an array of it has one item at most."""
    described = [
        one if isinstance(one, dict) else _typed(one[0], 1 + _ARRAYS[one[1]], int(bool(one[1])), 0, one[2])
        for one in fields
    ]
    return {name: {"type_name": name, "fields": described}}


def _field(name: str, type_: FieldType) -> _Description:
    of = "nested" if type_.package else f"{type_.name}<=" if type_.longest else type_.name
    return _typed(name, _NUMBERS[of] + _ARRAYS[type_.array], type_.size, type_.longest, type_.message)


def _typed(name: str, number: int, capacity: int, longest: int, nested: str) -> _Description:
    type_ = {"type_id": number, "capacity": capacity, "string_capacity": longest, "nested_type_name": nested}
    return {"name": name, "type": type_}
