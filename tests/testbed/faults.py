"""What goes wrong with a robot, on demand: each fault is a context manager and keeps the times of its begin and end.

    with faults.loss(bed, "sensor", 5) as fault:
        alarm = ...
    print(fault.after(alarm.since), "seconds to detect")

The wall clock is that of the machine, the one that agents and monitors in the bed use too. `clock.py` has the clock
offset.
"""

import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from testbed.hosts import INTERFACE, Bed, Host
from testbed.machine import BedError, system
from testbed.process import Process
from testbed.switch_control import SwitchControl

QUEUE = "400ms"  # what waits longer for its turn on a link with a rate is dropped
BURST = "32kb"
LEAK_LIMIT_MB = 256

_BURN = "while True: pass"
_LEAK = """
import sys, time
rate, limit, held = float(sys.argv[1]), float(sys.argv[2]), []
while True:
    if len(held) * 0.1 * rate < limit:
        held.append(b"x" * int(rate * 100_000))
    time.sleep(0.1)
"""


@dataclass
class Fault:
    """One fault. `began` and `ended` are wall clock times in seconds: when it was in force, and when it was over."""

    kind: str
    place: str
    began: float = float("nan")
    ended: float | None = None

    def after(self, moment: float) -> float:
        """Seconds from the fault's begin to `moment`: the detection time, when that is when it was noticed."""
        return moment - self.began


@contextlib.contextmanager
def in_force(kind: str, place: str, begin: Callable[[], object], end: Callable[[], object]) -> Iterator[Fault]:
    """Calls `begin`, hands out the fault, calls `end` whatever happens."""
    fault = Fault(kind, place)
    try:
        begin()
    except BaseException:
        with contextlib.suppress(BedError, OSError):  # what begun in part may have no end; the first error counts
            end()
        raise
    fault.began = time.time()
    try:
        yield fault
    finally:
        end()
        fault.ended = time.time()


def _switch(bed: Bed, kind: str) -> SwitchControl:
    if bed.switch is None:
        raise BedError(f"{kind} needs the user-space switch; make the bed with link='shaped'")
    return bed.switch


@contextlib.contextmanager
def _egress(bed: Bed, kind: str, host: str, **settings: float) -> Iterator[Fault]:
    switch = _switch(bed, kind)
    before = {key: switch.state()["hosts"][host][key] for key in settings}
    begin, end = (lambda: switch.change(host, **settings)), (lambda: switch.change(host, **before))
    with in_force(kind, host, begin, end) as fault:
        yield fault


@contextlib.contextmanager
def delay(bed: Bed, host: str, ms: float, jitter_ms: float = 0.0) -> Iterator[Fault]:
    """All that `host` sends arrives `ms` ms late, varying evenly by `jitter_ms` both ways. Shaped beds only."""
    with _egress(bed, "delay", host, delay_ms=ms, jitter_ms=jitter_ms) as fault:
        yield fault


@contextlib.contextmanager
def loss(bed: Bed, host: str, percent: float) -> Iterator[Fault]:
    """Of the frames that `host` sends, `percent` % vanish: in the switch, or by nftables at the bridge."""
    if bed.switch is not None:
        with _egress(bed, "loss", host, loss_percent=percent) as fault:
            yield fault
        return
    port = f"port{bed[host].number}"
    some = f"numgen random mod 10000 < {round(percent * 100)}" if percent < 100 else ""
    rules = (
        f"add table netdev {port}\n"
        f'add chain netdev {port} loss {{ type filter hook ingress device "{port}" priority 0; }}\n'
        f"add rule netdev {port} loss {some} drop\n"
    )
    nft = ["ip", "netns", "exec", bed.middle, "nft"]
    begin, end = (lambda: system(*nft, rules)), (lambda: system(*nft, "delete", "table", "netdev", port))
    with in_force("loss", host, begin, end) as fault:
        yield fault


@contextlib.contextmanager
def rate(bed: Bed, host: str, bits: float) -> Iterator[Fault]:
    """What `host` sends leaves at `bits` bit/s at most: in the switch, or by a token bucket at its interface."""
    if bed.switch is not None:
        with _egress(bed, "rate", host, rate_bit=bits) as fault:
            yield fault
        return
    tc = ["tc", "-n", bed[host].namespace, "qdisc"]
    bucket = ["tbf", "rate", f"{round(bits)}bit", "burst", BURST, "latency", QUEUE]
    with in_force(
        "rate",
        host,
        lambda: system(*tc, "replace", "dev", INTERFACE, "root", *bucket),
        lambda: system(*tc, "del", "dev", INTERFACE, "root"),
    ) as fault:
        yield fault


@contextlib.contextmanager
def unplugged(bed: Bed, host: str) -> Iterator[Fault]:
    """The host's network interface is down; its route for multicast comes back with it."""
    link = ["ip", "-n", bed[host].namespace]

    def plug() -> None:
        system(*link, "link", "set", INTERFACE, "up")
        system(*link, "route", "replace", "224.0.0.0/4", "dev", INTERFACE)

    with in_force("unplugged", host, lambda: system(*link, "link", "set", INTERFACE, "down"), plug) as fault:
        yield fault


@contextlib.contextmanager
def _programs(host: Host, kind: str, *commands: list[str]) -> Iterator[Fault]:
    running: list[Process] = []

    def begin() -> None:
        for number, command in enumerate(commands):
            running.append(host.start(command, name=f"{kind}-{number}".replace(" ", "-")))

    def end() -> None:
        for process in running:
            process.kill()

    with in_force(kind, host.name, begin, end) as fault:
        yield fault


@contextlib.contextmanager
def cpu_burn(host: Host, cores: int = 1) -> Iterator[Fault]:
    """Programs that never rest, one for each of `cores`."""
    with _programs(host, "cpu burn", *[[sys.executable, "-I", "-S", "-c", _BURN]] * cores) as fault:
        yield fault


@contextlib.contextmanager
def memory_leak(host: Host, mb_per_s: float, limit_mb: float = LEAK_LIMIT_MB) -> Iterator[Fault]:
    """A program that keeps `mb_per_s` million bytes more each second, up to `limit_mb`."""
    with _programs(
        host, "memory leak", [sys.executable, "-I", "-S", "-c", _LEAK, str(mb_per_s), str(limit_mb)]
    ) as fault:
        yield fault


@contextlib.contextmanager
def full_disk(host: Host) -> Iterator[Fault]:
    """The host's small disk (`host.disk`) has no byte left."""
    fillers = [str(host.disk / f"filler-{block}") for block in ("64k", "1k", "rest")]

    def fill() -> None:
        for filler in fillers:  # large blocks leave some that small ones take; the last is for what books take
            words = ["dd", "if=/dev/zero", f"of={filler}", f"bs={filler.rpartition('-')[2].replace('rest', '512')}"]
            host.run(words, check=False)  # ends with "no space left"

    with in_force("full disk", host.name, fill, lambda: host.run(["rm", "-f", *fillers])) as fault:
        yield fault


@contextlib.contextmanager
def frozen(process: Process) -> Iterator[Fault]:
    """The process exists and does nothing: SIGSTOP, SIGCONT."""
    with in_force(
        "frozen", process.name, lambda: process.send(signal.SIGSTOP), lambda: process.send(signal.SIGCONT)
    ) as fault:
        yield fault


@contextlib.contextmanager
def frozen_children(process: Process, word: str = "") -> Iterator[Fault]:
    """The process goes on, and those that it started, with `word` in their commands, stand still: SIGSTOP, SIGCONT."""
    stopped: list[int] = []

    def stop() -> None:
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        stopped.extend(int(one) for one in children if word in Path(f"/proc/{one}/cmdline").read_text(errors="replace"))
        if not stopped:
            raise BedError(f"{process.name} has no children that could be stopped")
        for pid in stopped:
            os.kill(pid, signal.SIGSTOP)

    def go_on() -> None:
        for pid in stopped:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGCONT)

    with in_force("children frozen", process.name, stop, go_on) as fault:
        yield fault


@contextlib.contextmanager
def silent_line(host: Host, port: int) -> Iterator[Fault]:
    """Nothing passes between `host` and TCP port `port` of others; whatever else it sends arrives."""
    rules = (
        "add table inet line\n"
        "add chain inet line out { type filter hook output priority 0; }\n"
        "add chain inet line in { type filter hook input priority 0; }\n"
        f"add rule inet line out tcp dport {port} drop\n"
        f"add rule inet line in tcp sport {port} drop\n"
    )
    nft = ["ip", "netns", "exec", host.namespace, "nft"]
    begin, end = (lambda: system(*nft, rules)), (lambda: system(*nft, "delete", "table", "inet", "line"))
    with in_force("silent line", host.name, begin, end) as fault:
        yield fault


@contextlib.contextmanager
def killed(process: Process) -> Iterator[Fault]:
    """The process is gone without a word (SIGKILL); afterwards it is started again."""
    with in_force("killed", process.name, process.kill, process.start_again) as fault:
        yield fault


@contextlib.contextmanager
def loaded(changes: Path, node: str, **load: float) -> Iterator[Fault]:
    """A running node of the robot has other `delay`, `leak` or `burn`, as `examples/robot/load.py` takes them.

    `changes` is `Robot.changes(node)`; the node sees it in its next cycle.
    """

    def write(text: str) -> None:
        fresh = changes.with_suffix(".new")
        fresh.write_text(text)
        fresh.replace(changes)

    lines = "".join(f"{key}={value}\n" for key, value in load.items())
    with in_force("load", node, lambda: write(lines), lambda: write("")) as fault:
        yield fault


@contextlib.contextmanager
def restarted(process: Process) -> Iterator[Fault]:
    """The process is asked to end, and started again; inside the context it is the new one."""

    def again() -> None:
        process.stop()
        process.start_again()

    with in_force("restarted", process.name, again, lambda: None) as fault:
        yield fault
