"""What the identifier of an endpoint reveals about the process that created it (Fast DDS).

Bytes 0 and 1 are the vendor's, 2 and 3 tell the host, 4 and 5 are the low 16 bits of the process id, little-endian, 6
and 7 are random; with 8 to 11 they are the prefix that all endpoints of a context share.
"""

from __future__ import annotations

from collections.abc import Sequence

VENDOR = "010f"


def text_of(gid: Sequence[int]) -> str:
    """Return an identifier as text: 16 bytes in hexadecimal, whatever the middleware appends."""
    return bytes(gid)[:16].hex()


def prefix(gid: str) -> str:
    """Return what the endpoints of one context share."""
    return gid[:24]


def pid_bits(gid: str) -> int | None:
    """Return the low 16 bits of the process id; None where the identifier is of another layout."""
    return (
        int(gid[8:10], 16) | int(gid[10:12], 16) << 8
        if gid.startswith(VENDOR) and len(gid) >= len(VENDOR) * 6
        else None
    )


def host_bits(gid: str) -> str:
    """Return the part that identifies the host; empty if the identifier has another layout."""
    return gid[4:8] if gid.startswith(VENDOR) else ""
