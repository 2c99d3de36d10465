"""The monitor's side of the lines from agents: accepts, authenticates, and hands over their frames."""

from __future__ import annotations

import selectors
import socket
from collections import Counter
from collections.abc import Callable

import msgspec

from roslens.live.agent.link import Channel, LinkError, StrangerError, named_pids, read_frame, reported_time
from roslens.live.observe.host_keys import HostKeys
from roslens.model.failure import Failure
from roslens.model.wire import Frame

MOST_LINES = 256
"""Agents at a time."""

MOST_UNPROVEN = 64
"""Connections at a time that have not proven that they know the key; they take no place of an agent's."""

MOST_UNPROVEN_OF_A_HOST = 8
SILENT_S = 10.0
"""An agent that sends nothing for so long is hung up on."""

PROOF_S = 5.0
"""Who has not proven that it knows the key so long after it connected is hung up on, whatever it sends."""

_FULL_PAUSE_S = 1.0
"""How long no connection is accepted after the system has run out of descriptors: a retry at once would fail too."""

_MOST_STRANGERS = 1024
_PIECE = 65_536
_MOST_UNSENT = 100_000


class _Line(msgspec.Struct, eq=False):
    """A connection and what is known of its other side."""

    socket: socket.socket
    peer: str
    channel: Channel
    begun: float
    last_received: float
    sending: bytearray
    sender: str = ""
    named: frozenset[int] | None = None


class Listener:
    """Listens for agents.

    A host belongs to the first key that named it, as long as this listens: who knows another key cannot speak for it.
    """

    def __init__(
        self, address: tuple[str, int], *keys: bytes, wall: Callable[[], float], steady: Callable[[], float]
    ) -> None:
        """Listen on ``address`` (port 0 takes a free one) for agents that know one of the keys.

        Raises:
            LinkError: a key is too short, or there are too many.
            OSError: the address cannot be listened on.
        """
        Channel(*keys, accepting=True)
        self._keys = keys
        self._host_keys = HostKeys()
        self._impostors: set[tuple[int, str]] = set()
        self._wall = wall
        self._steady = steady
        self._lines: dict[socket.socket, _Line] = {}
        self._named: dict[str, frozenset[int]] = {}
        self._strangers: set[str] = set()
        self._closed_until: float | None = None
        self._selector = selectors.DefaultSelector()
        self._socket = socket.create_server(address)
        self._socket.setblocking(False)
        self._selector.register(self._socket, selectors.EVENT_READ)

    @property
    def port(self) -> int:
        """The port that is listened on."""
        return int(self._socket.getsockname()[1])

    def agents(self) -> tuple[str, ...]:
        """Return who is connected, by the name they gave."""
        return tuple(sorted(line.sender for line in self._lines.values() if line.sender))

    def hosts(self) -> dict[str, str]:
        """Return the names of the hosts of agents by their address."""
        lines = (line for line in self._lines.values() if line.sender)
        return {line.peer.rpartition(":")[0]: line.sender.rpartition("/")[0] for line in lines}

    def descriptors(self) -> list[int]:
        """Return the descriptors that become readable when an agent sends data."""
        return [self._selector.fileno()]

    def poll(self, seconds: float = 0.0) -> list[Frame | Failure]:
        """Wait at most so long and return what came: frames, and what went wrong with a line."""
        found: list[Frame | Failure] = []
        self._open_again()
        for key, events in self._selector.select(seconds):
            if key.fileobj is self._socket:
                self._accept()
                continue
            line = self._lines.get(key.fileobj)  # type: ignore[call-overload]
            if line is None:
                continue
            if events & selectors.EVENT_READ:
                found += self._receive(line)
            if line.socket in self._lines and line.sending:
                self._send(line)
        found += self._too_silent()
        return found

    def name(self, host: str, pids: frozenset[int]) -> None:
        """Inform the agent of a host which processes contain nodes, if that is new to it."""
        self._named[host] = pids
        for line in list(self._lines.values()):
            self._tell_pids(line)

    def close(self) -> None:
        """Hang up on all and listen no more."""
        for line in list(self._lines.values()):
            self._hang_up(line)
        self._selector.close()
        self._socket.close()

    def _accept(self) -> None:
        try:
            accepted, peer = self._socket.accept()
        except BlockingIOError:
            return
        except OSError:
            self._selector.unregister(self._socket)
            self._closed_until = self._steady() + _FULL_PAUSE_S
            return
        if not self._has_room(peer[0]):
            accepted.close()
            return
        accepted.setblocking(False)
        accepted.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        channel = Channel(*self._keys, accepting=True)
        now = self._steady()
        line = _Line(accepted, f"{peer[0]}:{peer[1]}", channel, now, now, bytearray(channel.hello()))
        self._lines[accepted] = line
        self._selector.register(accepted, selectors.EVENT_READ | selectors.EVENT_WRITE)
        self._send(line)

    def _open_again(self) -> None:
        if self._closed_until is not None and self._steady() >= self._closed_until:
            self._closed_until = None
            self._selector.register(self._socket, selectors.EVENT_READ)

    def _has_room(self, host: str) -> bool:
        """Return whether another connection of a host may be kept; of too many strangers the oldest makes room."""
        unproven = [line for line in self._lines.values() if not line.channel.ready]
        if len(self._lines) - len(unproven) >= MOST_LINES:
            return False
        of_host = Counter(line.peer.rpartition(":")[0] for line in unproven)
        if of_host[host] >= MOST_UNPROVEN_OF_A_HOST:
            crowd = host
        elif len(unproven) >= MOST_UNPROVEN:
            crowd = of_host.most_common(1)[0][0]
        else:
            return True
        self._hang_up(next(line for line in unproven if line.peer.rpartition(":")[0] == crowd))
        return True

    def _receive(self, line: _Line) -> list[Frame | Failure]:
        received = self._wall()
        try:
            piece = line.socket.recv(_PIECE)
        except BlockingIOError:
            return []
        except OSError as error:
            return [*self._hang_up(line, f"the line broke: {error.strerror or error}")]
        if not piece:
            return self._left(line)
        line.last_received = self._steady()
        found: list[Frame | Failure] = []
        try:
            for letter, body in line.channel.feed(piece):
                if letter == "send":
                    line.sending += body
                elif letter == "T":
                    line.sending += line.channel.message("t", reported_time(body, received, self._wall()))
                elif letter == "F":
                    frame = read_frame(body)
                    if (refused := self._not_its_own(line, frame)) is not None:
                        return [*found, *refused]
                    found.append(frame)
        except StrangerError as error:
            return [*found, *self._refuse(line, str(error))]
        except LinkError as error:
            return [*found, *self._hang_up(line, str(error))]
        self._send(line)
        if line.socket in self._lines:
            self._tell_pids(line)
        return found

    def _not_its_own(self, line: _Line, frame: Frame) -> list[Failure] | None:
        """End the line of who speaks for the host of another key; return what is to be reported, once of key and host.

        Raises:
            LinkError: it has spoken in another name before.
        """
        if line.sender and line.sender != frame.sender:
            raise LinkError(f"it calls itself {frame.sender[:80]!r} now, expected one name for a connection")
        key = line.channel.key
        if key is None or (taken := self._host_keys.taken(frame, key)) is None:
            line.sender = frame.sender
            return None
        host, owner = taken
        self._hang_up(line)
        if (key, host) in self._impostors or len(self._impostors) >= _MOST_STRANGERS:
            return []
        self._impostors.add((key, host))
        at = line.peer.rpartition(":")[0]
        what = f"the connection from {at} knows key {key + 1} and speaks for the host {host[:80]!r}"
        expected = f"key {owner + 1}, with which that host was named first"
        advice = "Give agents different names with --name, or find the other holder of that key; more of this is "
        "refused silently"
        return [Failure("link", what, expected, advice)]

    def _send(self, line: _Line) -> None:
        while line.sending:
            try:
                sent = line.socket.send(line.sending)
            except BlockingIOError:
                break
            except OSError:
                line.sending.clear()
                return
            del line.sending[:sent]
        if len(line.sending) > _MOST_UNSENT:
            self._hang_up(line)
            return
        wanted = selectors.EVENT_READ | (selectors.EVENT_WRITE if line.sending else 0)
        self._selector.modify(line.socket, wanted)

    def _tell_pids(self, line: _Line) -> None:
        pids = self._named.get(line.sender.rpartition("/")[0])
        if pids is not None and line.channel.ready and line.named != pids:
            line.named = pids
            line.sending += line.channel.message("P", named_pids(pids))
            self._send(line)

    def _too_silent(self) -> list[Failure]:
        reported: list[Failure] = []
        now = self._steady()
        slow = [line for line in self._lines.values() if not line.channel.ready and now - line.begun > PROOF_S]
        for line in slow:
            reported += self._refuse(line, f"it did not prove within {PROOF_S:g} s that it knows the key")
        late = [line for line in self._lines.values() if now - line.last_received > SILENT_S]
        reported += [one for line in late for one in self._hang_up(line, f"it was silent for {SILENT_S:g} s")]
        return reported

    def _left(self, line: _Line) -> list[Frame | Failure]:
        if line.sender:
            return [*self._hang_up(line, "it hung up")]
        if line.channel.greeted and not line.channel.ready:
            return [*self._hang_up(line, "it hung up before it had proven the key: give both the same --key-file")]
        self._hang_up(line)
        return []

    def _hang_up(self, line: _Line, reason: str = "") -> list[Failure]:
        """End a line; return what is to be reported of it, in words that are the same each time that it happens."""
        self._selector.unregister(line.socket)
        line.socket.close()
        del self._lines[line.socket]
        # Without the port, which is another one each time that it tries again.
        host = line.peer.rpartition(":")[0]
        if not reason:
            return []
        if line.sender:
            what, expected = f"agent {line.sender!r} at {host}: {reason}", "an agent that keeps sending"
        else:
            what, expected = f"the connection from {host}: {reason}", "a roslens agent with the same key"
        return [Failure("link", what, expected=expected, advice="Look at its output")]

    def _refuse(self, line: _Line, found: str) -> list[Failure]:
        """Close the connection of a peer that is not an agent; this is reported once per host, for so many hosts."""
        self._hang_up(line)
        host = line.peer.rpartition(":")[0]
        if host in self._strangers or len(self._strangers) >= _MOST_STRANGERS:
            return []
        self._strangers.add(host)
        advice = "Look what connects from there; more of its connections are refused without a word"
        return [Failure("link", f"the connection from {host}: {found}", "a roslens agent with the same key", advice)]
