"""Calls a service of ROS 1: one connection, one request, one answer."""

from __future__ import annotations

import socket
import time
from urllib.parse import urlsplit

from roslens.live.act.ros import ActionError
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.tcpros import LARGEST_HEADER, TcprosError, decode_header, encode_header

_LARGEST_ANSWER = 16_000_000


def call_service(uri: str, service: str, caller: str, request: bytes, resolver: Resolver, timeout_s: float) -> bytes:
    """Return the serialised answer to a serialised request.

    Args:
        uri: ``rosrpc://host:port``, as the master tells it.
        service: its name.
        caller: our own name.
        request: serialised.
        resolver: finds addresses.
        timeout_s: for all of it.

    Raises:
        ActionError: there is no answer in time, or the server says that it failed.
    """
    end = time.monotonic() + timeout_s
    parts = urlsplit(uri)
    if parts.scheme != "rosrpc" or not parts.hostname or not parts.port:
        raise ActionError(f"{service} is at {uri[:80]!r}", expected="rosrpc://host:port")
    try:
        with socket.create_connection((resolver.address(parts.hostname), parts.port), timeout=timeout_s) as line:
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            # The wildcard lets a server of any type accept; what is sent fits the type that the document names.
            line.sendall(encode_header({"callerid": caller, "service": service, "md5sum": "*", "type": "*"}))
            size = int.from_bytes(_exactly(line, 4, end), "little")
            if size > LARGEST_HEADER:
                raise ActionError(f"{service} answers with a header of {size:,} bytes")
            header = decode_header(_exactly(line, size, end))
            if "error" in header:
                raise ActionError(f"{service} refuses: {header['error'][:200]}")
            line.sendall(len(request).to_bytes(4, "little") + request)
            good = _exactly(line, 1, end) == b"\1"
            size = int.from_bytes(_exactly(line, 4, end), "little")
            if size > _LARGEST_ANSWER:
                raise ActionError(f"{service} answers with {size:,} bytes", expected=f"at most {_LARGEST_ANSWER:,}")
            body = _exactly(line, size, end)
    except TimeoutError:
        raise ActionError(f"{service} did not answer", expected=f"an answer within {timeout_s:g} s") from None
    except (OSError, TcprosError) as error:
        raise ActionError(f"{service} cannot be called: {error}") from None
    if not good:
        raise ActionError(f"{service} failed: {body[:300].decode('utf-8', 'replace')}")
    return body


def _exactly(line: socket.socket, size: int, end: float) -> bytes:
    came = bytearray()
    while len(came) < size:
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError
        line.settimeout(left)
        piece = line.recv(min(size - len(came), 65_536))
        if not piece:
            raise TcprosError("the server hung up")
        came += piece
    return bytes(came)
