"""A network switch in user space: one TAP interface per host, with delay, jitter, loss and rate for what a host sends.

Not every kernel can delay frames (`tc netem` is a module of its own); a TAP interface is everywhere. Runs as a process
of its own, needs nothing but the standard library, and ends with its standard input:

    python switch.py [--seed N] CONTROL_SOCKET HOST=NAMESPACE...

It writes `ready` when all interfaces are up. Settings are changed live through the control socket: `switch_control.py`.
"""

import argparse
import contextlib
import ctypes
import errno
import fcntl
import heapq
import json
import os
import random
import select
import socket
import struct
import sys
import time
from pathlib import Path
from typing import Any

INTERFACE = "eth0"
LONGEST_FRAME = 65536
BATCH = 64  # frames taken from one host before the others get their turn
QUEUE_SECONDS = 1.0  # what waits longer for its turn on a slow link is dropped, as by a full queue
SETTINGS = ("delay_ms", "jitter_ms", "loss_percent", "rate_bit", "reorder")

_TUNSETIFF = 0x400454CA
_IFF_TAP, _IFF_NO_PI = 0x0002, 0x1000
_CLONE_NEWNET = 0x40000000
_TFD = os.O_NONBLOCK | os.O_CLOEXEC
_libc = ctypes.CDLL(None, use_errno=True)


class Egress:
    """What happens to the frames that one host sends.

    Attributes:
        delay_ms: Time on the way, milliseconds.
        jitter_ms: The delay varies evenly by up to this much in both directions.
        loss_percent: Share of frames that vanish.
        rate_bit: Bits a second, 0 for no limit. Frames queue for up to QUEUE_SECONDS.
        reorder: Whether jitter may let a frame overtake another; without it the later one waits.
    """

    def __init__(self, chance: random.Random) -> None:
        self.delay_ms = 0.0
        self.jitter_ms = 0.0
        self.loss_percent = 0.0
        self.rate_bit = 0.0
        self.reorder = 0.0
        self.received = self.lost = self.overrun = 0
        self._chance = chance
        self._free = 0.0
        self._last = 0.0

    def due(self, length: int, now: float) -> float | None:
        """When a frame of `length` bytes received at `now` (seconds) is to be delivered; None when it is lost."""
        self.received += 1
        if self.loss_percent and self._chance.random() * 100 < self.loss_percent:
            self.lost += 1
            return None
        at = now
        if self.rate_bit:
            at = max(now, self._free)
            if at - now > QUEUE_SECONDS:
                self.overrun += 1
                return None
            at = self._free = at + length * 8 / self.rate_bit
        if self.delay_ms or self.jitter_ms:
            at += max(0.0, self.delay_ms + self._chance.uniform(-self.jitter_ms, self.jitter_ms)) / 1000
        if not self.reorder:
            at = self._last = max(at, self._last)
        return at

    def change(self, settings: dict[str, Any]) -> None:
        """Takes new settings; raises ValueError for one that does not exist or is no number of zero or more."""
        for key, value in settings.items():
            if key not in SETTINGS:
                raise ValueError(f"{key!r} is no setting; expected one of {', '.join(SETTINGS)}")
            if not isinstance(value, (int, float)) or not 0 <= value < float("inf"):
                raise ValueError(f"{key} = {value!r}; expected a number of zero or more")
        for key, value in settings.items():
            setattr(self, key, float(value))

    def state(self) -> dict[str, float]:
        """Settings and counters."""
        return {key: getattr(self, key) for key in (*SETTINGS, "received", "lost", "overrun")}


class Switch:
    """Learns where addresses are, floods what is for all or for nobody known, and delivers frames when they are due."""

    def __init__(self, taps: dict[str, int], seed: int) -> None:
        self.taps = taps
        self.egress = {host: Egress(random.Random(f"{seed} {host}")) for host in taps}
        self.delivered = self.refused = 0
        self._from = {fd: self.egress[host] for host, fd in taps.items()}
        self._others = {fd: [other for other in taps.values() if other != fd] for fd in taps.values()}
        self._where: dict[bytes, int] = {}
        self._waiting: list[tuple[float, int, int, bytes]] = []
        self._order = 0

    def take(self, tap: int) -> None:
        """Reads what a host has sent and schedules or delivers it."""
        egress, where = self._from[tap], self._where
        for _ in range(BATCH):
            try:
                frame = os.read(tap, LONGEST_FRAME)
            except BlockingIOError:
                return
            now = time.monotonic()
            where[frame[6:12]] = tap
            at = egress.due(len(frame), now)
            if at is None:
                continue
            goal = -1 if frame[0] & 1 else where.get(frame[:6], -1)
            goals = self._others[tap] if goal < 0 else [goal] if goal != tap else []
            for goal in goals:
                if at <= now:
                    self._deliver(goal, frame)
                else:
                    self._order += 1
                    heapq.heappush(self._waiting, (at, self._order, goal, frame))

    def _deliver(self, goal: int, frame: bytes) -> None:
        try:
            os.write(goal, frame)
            self.delivered += 1
        except OSError:  # the interface is down or its queue full: frames get lost in real networks too
            self.refused += 1

    def deliver_due(self, now: float) -> float | None:
        """Delivers what is due and returns when the next frame will be."""
        waiting = self._waiting
        while waiting and waiting[0][0] <= now:
            _, _, goal, frame = heapq.heappop(waiting)
            self._deliver(goal, frame)
        return waiting[0][0] if waiting else None

    def _change(self, host: str, settings: dict[str, Any]) -> None:
        if host not in self.egress:
            raise ValueError(f"no host {host!r}; expected one of {', '.join(self.egress)}")
        self.egress[host].change(settings)

    def answer(self, request: bytes) -> bytes:
        """Carries out one request of the control socket, `{"host": NAME, SETTING: VALUE...}` or `{}`."""
        try:
            asked = json.loads(request)
            if not isinstance(asked, dict):
                raise TypeError(f"{request.decode()!r}: expected an object")  # noqa: TRY301
            if asked:
                self._change(asked.pop("host", None), asked)
        except (ValueError, TypeError, AttributeError) as error:
            return json.dumps({"error": str(error)}).encode()
        state = {
            "hosts": {host: egress.state() for host, egress in self.egress.items()},
            "delivered": self.delivered,
            "refused": self.refused,
            "waiting": len(self._waiting),
            "cpu_s": time.process_time(),
        }
        return json.dumps(state).encode()


class Timer:
    """A timer that `epoll` waits for; its own time limit has only milliseconds."""

    def __init__(self) -> None:
        self.fd = _libc.timerfd_create(time.CLOCK_MONOTONIC, _TFD)
        if self.fd < 0:
            raise OSError(ctypes.get_errno(), "timerfd_create")
        self._set: float | None = None

    def set(self, at: float | None) -> None:
        """Wakes at `at` of the monotonic clock (seconds), or never."""
        if at == self._set:
            return
        self._set = at
        seconds = at or 0.0
        value = struct.pack("qqqq", 0, 0, int(seconds), int(seconds % 1 * 1e9))
        if _libc.timerfd_settime(self.fd, 1, value, None) < 0:  # 1: absolute time
            raise OSError(ctypes.get_errno(), "timerfd_settime")

    def clear(self) -> None:
        """Takes note of a wake-up."""
        self._set = None
        with contextlib.suppress(BlockingIOError):
            os.read(self.fd, 8)


def open_tap(namespace: Path) -> int:
    """Makes the interface `eth0` in a network namespace and returns the file of its other end."""
    with Path("/proc/self/ns/net").open("rb") as home, namespace.open("rb") as there:
        try:
            if _libc.setns(there.fileno(), _CLONE_NEWNET) < 0:
                raise OSError(ctypes.get_errno(), f"cannot enter {namespace}")
            tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
            fcntl.ioctl(tap, _TUNSETIFF, struct.pack("16sH22x", INTERFACE.encode(), _IFF_TAP | _IFF_NO_PI))
        finally:
            _libc.setns(home.fileno(), _CLONE_NEWNET)
    return tap


def serve(switch: Switch, control: socket.socket) -> None:
    """Forwards frames and answers requests until standard input ends."""
    timer = Timer()
    epoll = select.epoll()
    for fd in (*switch.taps.values(), control.fileno(), timer.fd, 0):
        epoll.register(fd, select.EPOLLIN)
    taps = set(switch.taps.values())
    talks: dict[int, socket.socket] = {}
    while True:
        for fd, _ in epoll.poll():
            if fd in taps:
                switch.take(fd)
            elif fd == timer.fd:
                timer.clear()
            elif fd in talks:
                if not _talk(switch, talks[fd]):
                    epoll.unregister(fd)
                    talks.pop(fd).close()
            elif fd == control.fileno():
                talk, _ = control.accept()
                talks[talk.fileno()] = talk
                epoll.register(talk.fileno(), select.EPOLLIN)
            elif not os.read(0, 64):
                return
        timer.set(switch.deliver_due(time.monotonic()))


def _talk(switch: Switch, talk: socket.socket) -> bool:
    try:
        request = talk.recv(4096)
        if request:
            talk.send(switch.answer(request))
        return bool(request)
    except OSError as error:
        return error.errno == errno.EINTR


def main() -> None:
    """Runs the switch."""
    parser = argparse.ArgumentParser(description="A network switch in user space.")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("control", help="path of the control socket to make")
    parser.add_argument("ports", nargs="+", metavar="HOST=NAMESPACE")
    chosen = parser.parse_args()
    ports = dict(port.split("=", 1) for port in chosen.ports)
    taps = {host: open_tap(Path("/run/netns") / namespace) for host, namespace in ports.items()}
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as control:
        control.bind(chosen.control)
        control.listen()
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        serve(Switch(taps, chosen.seed), control)


if __name__ == "__main__":
    main()
