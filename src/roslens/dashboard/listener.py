"""The socket on which pages are served."""

from __future__ import annotations

import socket

from roslens.model.errors import UsageError


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


def address_shown(listener: socket.socket) -> str:
    """Return the address of the first page."""
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
