"""The socket on which pages are served."""

from __future__ import annotations

import socket
import ssl
from ipaddress import ip_address
from pathlib import Path

import msgspec

from roslens.model.errors import UsageError


class Tls(msgspec.Struct, frozen=True):
    """Files that a server encrypts with: its certificate, with those above it, and the key of that."""

    certificate: Path
    key: Path


def checked_tls(certificate: Path, key: Path) -> Tls:
    """Return the files, once they are seen to belong together.

    Raises:
        UsageError: one cannot be read, is not what it should be, or they are of different keys.
    """
    try:
        ssl.create_default_context(ssl.Purpose.CLIENT_AUTH).load_cert_chain(certificate, key, password=_no_password)
    except (OSError, ValueError) as error:
        # The text of an error of OpenSSL is its number and a line of its source; its reason is the name of it.
        reason = getattr(error, "reason", None) or getattr(error, "strerror", None) or error
        raise UsageError(
            f"cannot encrypt with {certificate} and {key}: {reason}",
            expected="a certificate and its key without a password, both in PEM",
        ) from error
    return Tls(certificate, key)


def _no_password() -> str:
    raise ValueError("the key has a password")


def listen(host: str, port: int, *, local: str, free: str) -> socket.socket:
    """Return a socket that accepts connections.

    Args:
        host: name or address to listen on.
        port: to listen on; 0 takes a free one.
        local: advice for when the host is none of this machine.
        free: advice for when the port is taken.

    Raises:
        UsageError: the host is unknown, or the port is taken or not allowed.
    """
    if not 0 <= port <= 65535:
        raise UsageError(f"port {port}", expected="a number from 0 to 65535")
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    except (OSError, UnicodeError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise UsageError(
            f"cannot listen on {host!r}: {reason}", expected="a name or address of this machine", advice=local
        ) from error
    listener = socket.socket(family, kind, protocol)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen(64)
    except OSError as error:
        listener.close()
        raise UsageError(
            f"cannot listen on {host}:{port}: {error.strerror}", expected="a free port", advice=free
        ) from error
    return listener


def address_shown(listener: socket.socket, *, encrypted: bool = False) -> str:
    """Return the address of the first page."""
    host, port = listener.getsockname()[:2]
    scheme = "https" if encrypted else "http"
    return f"{scheme}://[{host}]:{port}/" if ":" in host else f"{scheme}://{host}:{port}/"


def only_this_machine(host: str) -> bool:
    """Return whether a server that listens on ``host`` is reached from this machine alone.

    A name counts as what it stands for; one that stands for nothing is not only this machine.
    """
    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError):
        return False
    return all(ip_address(str(one[4][0]).partition("%")[0]).is_loopback for one in found)
