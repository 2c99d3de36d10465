"""The process that observes a ROS 1 system: frames on standard output until it is stopped."""

from __future__ import annotations

import argparse
import os
import queue
import signal
import socket
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

from roslens.judge.patterns.pattern import Pattern
from roslens.live.adapters.ros1.budget import Limits
from roslens.live.adapters.ros1.ends import Ends
from roslens.live.adapters.ros1.follow import Follower
from roslens.live.adapters.ros1.listening import Listening
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.names import observer_name
from roslens.live.adapters.ros1.observation import Observation
from roslens.live.adapters.ros1.parameters import Parameters
from roslens.live.adapters.ros1.place import is_local, own_address
from roslens.live.adapters.ros1.publisher_updates import UpdateServer
from roslens.live.adapters.ros1.publishing import MonitorPublisher
from roslens.live.adapters.ros1.resolve import Resolver, UnresolvedError
from roslens.live.adapters.ros1.speak import Speaker
from roslens.live.adapters.ros1.subscribed_topics import SubscribedTopics
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, split_uri
from roslens.live.publish.asked import when_asked

DEFAULT_MASTER = "http://localhost:11311"
PARAMETERS_WAIT_S = 10.0
"""The longest time that the parameter server may take to return all parameters."""
_SETTLE_S = 0.25
"""A node that registers is reported at its first registration; so much later it has made the others."""
HEARD_S = 0.1
"""How often what a tap counts is passed on."""
GATHER_S = 0.03
"""How long what a node tells of itself waits for what others do. An alarm may come 0.2 s after its window: nodes tell
every 0.15 s, and all others on the way share the rest."""


def read_arguments(words: list[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros1", description=__doc__)
    parser.add_argument("--master", metavar="URI", default=os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER)
    parser.add_argument("--period", type=_positive, default=1.0, metavar="S", help="seconds between rounds")
    parser.add_argument(
        "--statistics", action="store_true", help="read the statistics that subscribers publish on /statistics"
    )
    parser.add_argument("--parameters", action="store_true", help="read the parameter server")
    parser.add_argument("--reports", action="store_true", help="read the reports of other monitors on /diagnostics")
    parser.add_argument("--tap", action="append", default=[], type=_pattern, metavar="PATTERN", help="topics to read")
    parser.add_argument("--tap-budget", type=_share, default=0.05, metavar="PERCENT", help="CPU of the tap (5)")
    parser.add_argument("--tap-rate", type=_positive, default=5000.0, metavar="N", help="messages/s of the tap (5000)")
    parser.add_argument("--tap-bytes", type=_positive, default=50e6, metavar="N", help="bytes/s of the tap (50e6)")
    parser.add_argument("--diagnostics", action="store_true", help="publish what standard input requests")
    parser.add_argument("--rated", default="", metavar="TOPIC", help="publish rated signals that are asked there too")
    options = parser.parse_args(words)
    try:
        split_uri(options.master)
    except CallError as error:
        parser.error(f"--master: {error}")
    return options


def _positive(text: str) -> float:
    return _number(text, 0.01, 1e12)


def _share(text: str) -> float:
    return _number(text, 0.01, 100) / 100


def _number(text: str, least: float, most: float) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not least <= value <= most:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number from {least:g} to {most:g}")
    return value


def _pattern(text: str) -> Pattern:
    try:
        return Pattern.parse(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _complain(text: str) -> None:
    sys.stderr.write(f"error: {text}\n")
    sys.stderr.flush()


def _stop(*_: object) -> None:
    raise SystemExit(0)


Wake = tuple[str, str, tuple[str, ...]]


def observe(options: argparse.Namespace, speaker: Speaker) -> None:
    """Observe until stopped."""
    resolver = Resolver()
    host, port = split_uri(options.master)
    caller = observer_name(socket.gethostname(), os.getpid())
    wakes: queue.SimpleQueue[Wake] = queue.SimpleQueue()
    towards = host
    with suppress(UnresolvedError):
        towards = resolver.address(host)
    own = own_address(os.environ, towards, port)
    at = ""
    with suppress(UnresolvedError):
        at = resolver.address(own)
    listened = at if is_local(at) else ""
    publisher = _monitor_publisher(options, listened, own, caller)
    updates = UpdateServer(
        listened, own, options.master, lambda topic, uris: wakes.put(("updated", topic, uris)),
        publisher.answers if publisher else None,
    )  # fmt: skip
    ends = Ends(lambda name: wakes.put(("ended", name, ())))
    publications = publisher.publications if publisher else ()
    follower = Follower(Master(options.master, caller, resolver), caller, updates.uri, publications)
    parameters = _parameters(options, caller, resolver, updates) if options.parameters else None
    observation = Observation(
        follower, caller, resolver, socket.gethostname(), time.time, ends, parameters=parameters
    )  # fmt: skip
    limits = Limits(options.tap_budget, options.tap_rate, options.tap_bytes)
    listening = Listening(
        caller, resolver, time.time, socket.gethostname(), limits, news=lambda: wakes.put(("changed", "", ()))
    )
    subscribed = SubscribedTopics(
        observation, listening, tuple(options.tap), options.statistics, caller, reports=options.reports
    )
    try:
        _turn(options.period, observation, subscribed, speaker, wakes)
    finally:
        if parameters:
            parameters.leave(lambda _: None)
        follower.leave(lambda _: None)
        listening.close()
        observation.close()
        ends.close()
        updates.close()
        if publisher:
            publisher.close()


def _monitor_publisher(options: argparse.Namespace, address: str, own: str, caller: str) -> MonitorPublisher | None:
    """Publish what comes on standard input, where that was asked for."""
    if not (options.diagnostics or options.rated):
        return None
    publisher = MonitorPublisher(address, own, caller, diagnostics=options.diagnostics, rated=options.rated)
    when_asked(0, publisher.publish, _complain)
    return publisher


def _parameters(options: argparse.Namespace, caller: str, resolver: Resolver, updates: UpdateServer) -> Parameters:
    """Return what reads the parameter server, over a line and in a thread of its own."""
    pool = ThreadPoolExecutor(1, "parameters")
    parameters = Parameters(
        Master(options.master, caller, resolver, PARAMETERS_WAIT_S), updates.uri, time.monotonic, pool.submit
    )
    updates.parameter_reported = parameters.note
    return parameters


def _turn(
    period: float,
    observation: Observation,
    subscribed: SubscribedTopics,
    speaker: Speaker,
    wakes: queue.SimpleQueue[Wake],
) -> None:
    moved: frozenset[str] = frozenset()
    due = time.monotonic()
    hear = due + HEARD_S
    while True:
        now = time.monotonic()
        if now >= due:
            speaker.say(subscribed.round(moved))
            moved = frozenset()
            due = max(now + period, time.monotonic() + period / 10)
            hear = time.monotonic() + HEARD_S
        elif now >= hear:
            hear = now + HEARD_S
            speaker.say(subscribed.received())
        with suppress(queue.Empty):
            what, name, uris = wakes.get(timeout=max(min(due, hear) - time.monotonic(), 0.0))
            if what == "ended":
                frame = observation.ended([name])
                if frame:
                    speaker.say(frame)
            elif what == "changed":
                hear = min(hear, time.monotonic() + GATHER_S)
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
