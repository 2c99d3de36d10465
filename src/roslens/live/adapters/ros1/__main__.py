"""The process that observes a ROS 1 system: frames on standard output until it is told to stop."""

from __future__ import annotations

import argparse
import os
import queue
import signal
import socket
import sys
import time
from contextlib import suppress

from roslens.live.adapters.ros1.ends import Ends
from roslens.live.adapters.ros1.follow import Follower
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.observation import Observation
from roslens.live.adapters.ros1.place import own_address
from roslens.live.adapters.ros1.resolve import Resolver, UnresolvedError
from roslens.live.adapters.ros1.speak import Speaker
from roslens.live.adapters.ros1.told import ToldServer
from roslens.live.adapters.ros1.xml_rpc import CallError, split_uri

DEFAULT_MASTER = "http://localhost:11311"
_SETTLE_S = 0.25
"""A node that registers is told of at its first registration; so much later it has made the others."""


def read_arguments(words: list[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros1", description=__doc__)
    parser.add_argument("--master", metavar="URI", default=os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER)
    parser.add_argument("--period", type=_positive, default=1.0, metavar="S", help="seconds between rounds")
    options = parser.parse_args(words)
    try:
        split_uri(options.master)
    except CallError as error:
        parser.error(f"--master: {error}")
    return options


def _positive(text: str) -> float:
    value = float(text)
    if not 0.01 <= value <= 3600:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of seconds from 0.01 to 3600")
    return value


def _stop(*_: object) -> None:
    raise SystemExit(0)


Wake = tuple[str, str, tuple[str, ...]]


def observe(options: argparse.Namespace, speaker: Speaker) -> None:
    """Observe until stopped."""
    resolver = Resolver()
    host, port = split_uri(options.master)
    caller = f"/roslens_{socket.gethostname().replace('-', '_').replace('.', '_')}_{os.getpid()}"
    wakes: queue.SimpleQueue[Wake] = queue.SimpleQueue()
    towards = host
    with suppress(UnresolvedError):
        towards = resolver.address(host)
    own = own_address(os.environ, towards, port)
    told = ToldServer("", own, options.master, lambda topic, uris: wakes.put(("told", topic, uris)))
    ends = Ends(lambda name: wakes.put(("ended", name, ())))
    follower = Follower(Master(options.master, caller, resolver), caller, told.uri)
    observation = Observation(follower, caller, resolver, socket.gethostname(), time.time, ends)
    try:
        _turn(options.period, observation, speaker, wakes)
    finally:
        follower.leave(lambda _: None)
        observation.close()
        ends.close()
        told.close()


def _turn(period: float, observation: Observation, speaker: Speaker, wakes: queue.SimpleQueue[Wake]) -> None:
    moved: frozenset[str] = frozenset()
    due = time.monotonic()
    while True:
        left = due - time.monotonic()
        if left <= 0:
            begun = time.monotonic()
            speaker.say(observation.round(moved))
            moved = frozenset()
            due = max(begun + period, time.monotonic() + period / 10)
            continue
        with suppress(queue.Empty):
            what, name, uris = wakes.get(timeout=left)
            if what == "ended":
                frame = observation.ended([name])
                if frame:
                    speaker.say(frame)
            else:
                moved |= observation.moved(name, uris)
                due = min(due, time.monotonic() + _SETTLE_S)


def main(words: list[str]) -> int:
    """Run; return the exit code."""
    options = read_arguments(words)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, _stop)
    try:
        observe(options, Speaker(sys.stdout.buffer))
    except BrokenPipeError:
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
