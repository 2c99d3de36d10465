"""Calls of XML-RPC methods that end in time, whatever the other side does."""

from __future__ import annotations

import re
import socket
import time
import xmlrpc.client
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from typing import Any
from urllib.parse import urlsplit
from xml.etree.ElementTree import Element, ParseError, fromstring
from xml.parsers.expat import ExpatError

from roslens.live.adapters.ros1.resolve import Resolver, UnresolvedError

LARGEST_ANSWER = 32_000_000
_LARGEST_HEAD = 16_384
_PIECE = 65_536
_LENGTH = re.compile(rb"^content-length:\s*(\d{1,12})\s*$", re.IGNORECASE | re.MULTILINE)
_CLOSES = re.compile(rb"^connection:\s*close", re.IGNORECASE | re.MULTILINE)
_UNREADABLE = (
    ExpatError, xmlrpc.client.ResponseError, ValueError, TypeError, KeyError, IndexError, LookupError, AttributeError,
    OverflowError, AssertionError,
)  # fmt: skip


_DEEPEST = 32
_SIMPLE: dict[str, Callable[[str], Any]] = {
    "string": str, "int": int, "i4": int, "i8": int, "double": float, "boolean": lambda text: text.strip() == "1",
    "nil": lambda _: None, "dateTime.iso8601": str, "base64": str,
}  # fmt: skip


class Trouble(str, Enum):
    """Why a call gave no answer.

    ``refused``: nobody listens there. ``silent``: somebody listens and does not answer in time. ``unreachable``: no
    way leads there. ``garbled``: the answer is none. ``denied``: the other side answers that it will not or cannot.
    """

    REFUSED = "refused"
    SILENT = "silent"
    UNREACHABLE = "unreachable"
    GARBLED = "garbled"
    DENIED = "denied"


class CallError(Exception):
    """A call without an answer; its text states what was found."""

    def __init__(self, trouble: Trouble, text: str) -> None:
        super().__init__(text)
        self.trouble = trouble


def split_uri(uri: str) -> tuple[str, int]:
    """Return host and port of ``http://host:port/``.

    Raises:
        CallError: it is no such URI.
    """
    host, port = None, None
    if uri.startswith("http://"):
        with suppress(ValueError):
            parts = urlsplit(uri)
            host, port = parts.hostname, parts.port
    if not host or not port:
        raise CallError(Trouble.GARBLED, f"{uri[:80]!r} is not a URI of the form http://host:port/")
    return host, port


class Caller:
    """One XML-RPC server, spoken to over one connection that is kept open; not for two threads at once.

    Attributes:
        uri: of the server.
        wait_s: the longest a call may take, connecting included.
    """

    def __init__(self, uri: str, resolver: Resolver, wait_s: float = 1.0, largest: int = LARGEST_ANSWER) -> None:
        self.uri = uri
        self.wait_s = wait_s
        self._resolver = resolver
        self._largest = largest
        self._line: socket.socket | None = None

    def call(self, method: str, *arguments: Any) -> Any:
        """Return what the method returns, whatever that is.

        Raises:
            CallError: there is no answer.
        """
        return read_answer(self.ask(method, *arguments), method)

    def ask(self, method: str, *arguments: Any) -> bytes:
        """Return the answer as it was sent, so that an unchanged one need not be read again.

        Raises:
            CallError: there is no answer.
        """
        body = xmlrpc.client.dumps(arguments, method).encode()
        host, port = split_uri(self.uri)
        bracketed = f"[{host}]" if ":" in host else host
        try:
            name = bracketed.encode("idna") if not bracketed.isascii() else bracketed.encode()
        except UnicodeError:
            raise CallError(Trouble.GARBLED, f"{host[:60]!r} is not a host name") from None
        request = b"POST /RPC2 HTTP/1.1\r\nHost: %s:%d\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n%s" % (
            name,
            port,
            len(body),
            body,
        )
        end = time.monotonic() + self.wait_s
        if self._line is not None:
            try:
                return self._exchange(self._line, request, end)
            except (OSError, EOFError):
                if time.monotonic() >= end:
                    self.close()
                    raise CallError(Trouble.SILENT, self._no_answer()) from None
                self.close()  # it had been closed while idle; a new one tells whether anybody is there
            except CallError:
                self.close()
                raise
        return self._ask_anew(host, port, request, end)

    def _ask_anew(self, host: str, port: int, request: bytes, end: float) -> bytes:
        try:
            address = self._resolver.address(host)
            line = socket.create_connection((address, port), timeout=max(end - time.monotonic(), 0.01))
        except UnresolvedError as error:
            raise CallError(Trouble.UNREACHABLE, str(error)) from None
        except ConnectionRefusedError:
            raise CallError(Trouble.REFUSED, f"{self.uri[:120]} refuses connections") from None
        except TimeoutError:
            raise CallError(Trouble.SILENT, self._no_answer()) from None
        except (OSError, OverflowError) as error:
            raise CallError(Trouble.UNREACHABLE, f"{self.uri[:120]} cannot be reached: {error}") from None
        try:
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._line = line
            return self._exchange(line, request, end)
        except TimeoutError:
            self.close()
            raise CallError(Trouble.SILENT, self._no_answer()) from None
        except (OSError, EOFError) as error:
            self.close()
            raise CallError(Trouble.GARBLED, f"{self.uri[:120]} hung up in the middle: {error}") from None
        except CallError:
            self.close()
            raise

    def _no_answer(self) -> str:
        return f"{self.uri[:120]} does not answer within {self.wait_s:g} s"

    def _exchange(self, line: socket.socket, request: bytes, end: float) -> bytes:
        line.settimeout(max(end - time.monotonic(), 0.01))
        line.sendall(request)
        came = bytearray()
        while (cut := came.find(b"\r\n\r\n")) < 0:
            if len(came) > _LARGEST_HEAD:
                raise CallError(Trouble.GARBLED, f"{self.uri[:120]} does not speak HTTP: {bytes(came[:40])!r}")
            self._more(line, came, end)
        head, body = bytes(came[:cut]), came[cut + 4 :]
        if not head.startswith(b"HTTP/1.") or head[8:13] != b" 200 ":
            raise CallError(Trouble.GARBLED, f"{self.uri[:120]} answers {head[:60]!r} instead of HTTP 200")
        length = _LENGTH.search(head)
        if length is None:
            return self._until_closed(line, body, end)
        size = int(length.group(1))
        if size > self._largest:
            raise CallError(Trouble.GARBLED, f"an answer of {size:,} bytes, expected at most {self._largest:,}")
        while len(body) < size:
            self._more(line, body, end)
        if head.startswith(b"HTTP/1.0") or _CLOSES.search(head):
            self.close()
        return bytes(body[:size])

    def _until_closed(self, line: socket.socket, body: bytearray, end: float) -> bytes:
        try:
            while True:
                if len(body) > self._largest:
                    raise CallError(Trouble.GARBLED, f"an answer of more than {self._largest:,} bytes")
                self._more(line, body, end)
        except EOFError:
            self.close()
        return bytes(body)

    def _more(self, line: socket.socket, into: bytearray, end: float) -> None:
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError
        line.settimeout(left)
        piece = line.recv(_PIECE)
        if not piece:
            raise EOFError("closed")
        into += piece

    @property
    def descriptor(self) -> int:
        """The open connection, whose end is the end of the process there; -1 without one."""
        return self._line.fileno() if self._line else -1

    def close(self) -> None:
        """Hang up."""
        if self._line:
            self._line.close()
            self._line = None


def read_message(body: bytes, what: str) -> tuple[tuple[Any, ...], str]:
    """Return the values in a call or an answer, and the method of a call.

    Raises:
        CallError: it is an answer that says that the method failed, or no message.
    """
    if b"<!DOCTYPE" in body or b"<!ENTITY" in body:
        raise CallError(Trouble.GARBLED, f"{what} defines entities, which XML-RPC does not know")
    try:
        values, method = xmlrpc.client.loads(body)
    except xmlrpc.client.Fault as fault:
        raise CallError(Trouble.DENIED, f"{what}: failed there: {str(fault.faultString)[:300]}") from None
    except _UNREADABLE as error:
        raise CallError(Trouble.GARBLED, f"{what} is not XML-RPC: {str(error)[:200]}") from None
    return values, method or ""


def read_answer(body: bytes, method: str) -> Any:
    """Return the value in the body of an answer.

    The parser of the standard library's client is Python for every tag; this one asks the parser in C for the tree and
    takes about half the time, which is most of what observing by protocol costs.

    Raises:
        CallError: it is an answer that says that the method failed, or none.
    """
    if b"<!DOCTYPE" in body or b"<!ENTITY" in body:
        raise CallError(Trouble.GARBLED, f"the answer to {method} defines entities, which XML-RPC does not know")
    try:
        root = fromstring(body)  # noqa: S314 - entities were refused above
        fault = root.find("fault/value")
        places = [fault] if fault is not None else root.findall("params/param/value")
        values = [_value(place, 0) for place in places if place is not None]
    except (ParseError, ValueError, LookupError, OverflowError) as error:
        raise CallError(Trouble.GARBLED, f"the answer to {method} is not XML-RPC: {str(error)[:200]}") from None
    if root.tag != "methodResponse" or len(values) != 1:
        what = f"the answer to {method} is {root.tag[:40]!r} with {len(values)} values, expected methodResponse with 1"
        raise CallError(Trouble.GARBLED, what)
    if fault is not None:
        said = values[0].get("faultString", "") if isinstance(values[0], dict) else values[0]
        raise CallError(Trouble.DENIED, f"the answer to {method}: failed there: {str(said)[:300]}")
    return values[0]


def _value(place: Element, depth: int) -> Any:
    """Return what a ``value`` holds; text where no type is given."""
    if depth > _DEEPEST:
        raise ValueError(f"values nested more than {_DEEPEST} deep")
    if not len(place):
        return place.text or ""
    typed = place[0]
    if typed.tag == "array":
        return [_value(inner, depth + 1) for data in typed for inner in data]
    if typed.tag == "struct":
        return {
            member.findtext("name", ""): _value(inner, depth + 1)
            for member in typed.iterfind("member")
            if (inner := member.find("value")) is not None
        }
    read = _SIMPLE.get(typed.tag)
    if read is None:
        raise ValueError(f"a value of the type {typed.tag[:40]!r}")
    return read(typed.text or "")


def unwrap(answer: Any, method: str) -> Any:
    """Return the value of ``[code, message, value]``, the form in which ROS answers.

    Raises:
        CallError: it has another form, or its code says that it failed.
    """
    if not isinstance(answer, list) or len(answer) != 3 or not isinstance(answer[0], int):
        raise CallError(Trouble.GARBLED, f"{method} answers {repr(answer)[:80]}, expected [code, message, value]")
    if answer[0] != 1:
        raise CallError(Trouble.DENIED, f"{method} answers with code {answer[0]}: {str(answer[1])[:200]}")
    return answer[2]
