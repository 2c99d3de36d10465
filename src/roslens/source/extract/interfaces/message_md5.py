"""The MD5 sum of a ROS 1 type, which publisher and subscriber compare when they connect.

It is that of genmsg (``genmsg.gentools.compute_md5``): the MD5 of the constants and then the fields, a line each,
without comments; a field that is a message has the sum of that message in place of its type.
"""

from __future__ import annotations

from hashlib import md5

from roslens.source.extract.interfaces.interface import (
    Checksum,
    Interface,
    InterfaceField,
    Lookup,
    Message,
    unknown_field_type,
)
from roslens.source.extract.interfaces.interface_derived import ros1_messages

_DEEPEST = 100


def md5_of(interface: Interface, lookup: Lookup) -> Checksum:
    """Return the sum of a message, service or action of ROS 1; that of an action is the one of ``XAction``.

    Args:
        interface: what to sum up.
        lookup: finds the messages of its fields. Messages that services and actions consist of are found without it.
    """
    return md5_sums(interface, lookup)[interface.full_name]


def md5_sums(interface: Interface, lookup: Lookup) -> dict[str, Checksum]:
    """Return the sums of ``interface`` and of the messages that it consists of, by full name."""
    own = ros1_messages(interface)
    sums = _Sums(lookup, own)
    found = {interface.full_name: sums.of(interface)}
    found.update((one.full_name, sums.of(one)) for one in own)
    if interface.kind == "action":
        found[interface.full_name] = found[f"{interface.package}/msg/{interface.name}Action"]
    return found


class _Sums:
    def __init__(self, lookup: Lookup, own: tuple[Interface, ...]) -> None:
        self._lookup = lookup
        self._own = {one.full_name: one for one in own}
        self._known: dict[str, Checksum] = {}
        self._open: list[str] = []

    def of(self, interface: Interface) -> Checksum:
        name = interface.full_name
        if name in self._known:
            return self._known[name]
        if not interface.complete:
            return Checksum(unknown=f"the file of {name} could not be parsed completely")
        if interface.generation != 1:
            return Checksum(unknown=f"{name} is an interface of ROS {interface.generation}")
        if name in self._open:
            return Checksum(unknown=f"{name} contains itself")
        if len(self._open) > _DEEPEST:
            return Checksum(unknown=f"more than {_DEEPEST} levels of nested messages, down to {name}")
        self._open.append(name)
        self._known[name] = found = self._summed(name, interface.parts)
        self._open.pop()
        return found

    def _summed(self, name: str, parts: tuple[Message, ...]) -> Checksum:
        total = md5(usedforsecurity=False)
        for part in parts:
            lines = [f"{constant.type} {constant.name}={constant.written}" for constant in part.constants]
            for field in part.fields:
                type_ = self._type(name, field)
                if not type_:
                    return type_
                lines.append(f"{type_.text} {field.name}")
            total.update("\n".join(lines).strip().encode())
        return Checksum(total.hexdigest())

    def _type(self, owner: str, field: InterfaceField) -> Checksum:
        full_name = field.type.message
        if not full_name:
            return Checksum(field.type.written)
        message = self._own.get(full_name) or self._lookup(full_name)
        return unknown_field_type(owner, field) if message is None else self.of(message)
