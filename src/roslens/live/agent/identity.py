"""What Fast DDS puts into identifiers to identify the host: 16 bits of its IPv4 addresses.

Source: eProsima/Fast-DDS, ``src/cpp/utils/Host.hpp`` (``compute_id``) and ``GuidUtils``: MD5 over the addresses, in the
order of the interfaces and without loopback, each in the last 4 of 16 bytes; the 8 big-endian halves of the digest by
exclusive or, written with the low byte first. Some older versions put the name of the host before the addresses.
A host without an address has an identity that all such hosts have: it shows nothing.
"""

from __future__ import annotations

import ctypes
import hashlib
import socket
from collections.abc import Iterable
from typing import Any

_RUNNING = 0x40
_BEFORE = bytes(12)


class _Address(ctypes.Structure):
    _fields_ = (("family", ctypes.c_ushort), ("port", ctypes.c_ushort), ("ipv4", ctypes.c_ubyte * 4))


class _Interface(ctypes.Structure):
    """A ``struct ifaddrs``, as Linux has it."""


_Interface._fields_ = (
    ("next", ctypes.POINTER(_Interface)),
    ("name", ctypes.c_char_p),
    ("flags", ctypes.c_uint),
    ("address", ctypes.POINTER(_Address)),
    ("netmask", ctypes.c_void_p),
    ("broadcast", ctypes.c_void_p),
    ("data", ctypes.c_void_p),
)


def own_addresses() -> list[bytes]:
    """Return the IPv4 addresses of this host in the order of its interfaces, without loopback."""
    library: Any = ctypes.CDLL(None)
    first = ctypes.POINTER(_Interface)()
    if library.getifaddrs(ctypes.byref(first)) != 0:
        return []
    found = []
    try:
        one: Any = first
        while one:
            interface = one.contents
            address = interface.address
            if address and interface.flags & _RUNNING and address.contents.family == socket.AF_INET:
                found.append(bytes(address.contents.ipv4))
            one = interface.next
    finally:
        library.freeifaddrs(first)
    return [address for address in dict.fromkeys(found) if address[0] != 127]


def identities(addresses: Iterable[bytes], host_name: str) -> tuple[str, ...]:
    """Return the bits of a host as they stand in identifiers, in hexadecimal: of newer versions, then of older ones."""
    padded = b"".join(_BEFORE + address for address in addresses)
    if not padded:
        return ()
    return (_folded(padded), _folded(host_name.encode() + padded))


def own_identities() -> tuple[str, ...]:
    """Return the bits of this host; nothing where they cannot be determined."""
    try:
        return identities(own_addresses(), socket.gethostname())
    except (OSError, AttributeError):
        return ()


def _folded(text: bytes) -> str:
    digest = hashlib.md5(text, usedforsecurity=False).digest()
    bits = 0
    for at in range(0, len(digest), 2):
        bits ^= int.from_bytes(digest[at : at + 2], "big")
    return bits.to_bytes(2, "little").hex()
