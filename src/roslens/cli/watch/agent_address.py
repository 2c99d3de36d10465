"""Where monitor and agents meet: a host and a port as a user writes them, and the ports if none is given."""

from __future__ import annotations

from roslens.model.errors import UsageError

DEFAULT_PORT = 7411
DEFAULT_REQUESTS_PORT = 7412


def address_of(text: str, default_port: int = DEFAULT_PORT) -> tuple[str, int]:
    """Read ``host``, ``host:port``, ``[v6]:port`` or a bare IPv6 address.

    Raises:
        UsageError: the port is no port.
    """
    host, separator, port = text.rpartition(":")
    if not separator or text.endswith("]") or (":" in host and not host.startswith("[")):
        host, port = text, str(default_port)
    if not port.isdigit() or not 0 <= int(port) < 65536 or not host:
        raise UsageError(f"{text!r} is not an address", expected="HOST, HOST:PORT or [IPv6]:PORT")
    return host.strip("[]"), int(port)
