"""The process that observes a ROS 2 system: frames on standard output until it is stopped."""

from __future__ import annotations

import argparse
import os
import queue
import signal
import socket
import sys
import time
from contextlib import suppress
from typing import Any, BinaryIO

import msgspec

from roslens.live.adapters.ros2 import TOOL
from roslens.live.adapters.ros2.far_peers import far_peers
from roslens.live.adapters.ros2.graph import OWN, GraphReader
from roslens.live.adapters.ros2.graph_event import GraphEvent
from roslens.live.adapters.ros2.lifecycle import Lifecycles, StateClient
from roslens.live.adapters.ros2.observation import Observation
from roslens.live.adapters.ros2.parameters import NodeQuestions, Parameters
from roslens.live.adapters.ros2.process_ends import ProcessEnds
from roslens.live.adapters.ros2.publishing import MonitorPublisher
from roslens.live.adapters.ros2.reported_topics import ReportedTopics
from roslens.live.adapters.ros2.tap import DRAIN_S, Tap
from roslens.live.inside.counters import CounterReader
from roslens.live.inside.slots import folder_of
from roslens.live.publish.asked import when_asked
from roslens.live.reported.attention import PAUSE_S, Attention
from roslens.model.failure import Failure
from roslens.model.wire import MAX_FRAME_BYTES, VERSION, Frame, encode_frame

SETTLE_S = 0.08
"""How long changes of the graph are gathered: a node that starts makes a dozen."""
ASKING_SETTLE_S = 0.4
"""The same while nodes are asked for their parameters, since every question is a change of the graph."""
ASK_S = 0.02
"""How long it is from one look for their answers to the next."""
LOOK_S = 1.0
"""How often the graph is read if nothing reports its changes."""
MEET_S = 0.5
"""How long the first graph waits: who was there before is met in that time, and did not appear."""
COUNT_EVERY_S = 0.15
"""An alarm may come 0.2 s after its window: counting, the line and the monitor share that."""
_LARGEST_DOMAIN = 232
_CHANGED = (0, "")
"""The graph changed, and no process is known to have ended."""


def read_arguments(words: list[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros2", description=__doc__)
    parser.add_argument("--domain", type=int, metavar="N", help="domain id (default: that of the environment)")
    parser.add_argument("--period", type=_period, default=COUNT_EVERY_S, metavar="S", help="seconds between frames")
    parser.add_argument("--tap", action="append", default=[], metavar="PATTERN", help="subscribe to these topics too")
    parser.add_argument("--tap-budget", type=_percent, default=10.0, metavar="PERCENT", help="of a core for --tap")
    parser.add_argument("--diagnostics", action="store_true", help="publish what standard input requests")
    parser.add_argument("--rated", default="", metavar="TOPIC", help="publish rated signals that are asked there too")
    options = parser.parse_args(words)
    if options.domain is not None and not 0 <= options.domain <= _LARGEST_DOMAIN:
        parser.error(f"--domain {options.domain}: expected 0 to {_LARGEST_DOMAIN}")
    return options


def _period(text: str) -> float:
    value = float(text)
    if not 0.05 <= value <= 8:
        # The counters of nodes keep their extremes for 8.5 s.
        raise argparse.ArgumentTypeError(f"{text!r}; expected a number of seconds from 0.05 to 8")
    return value


def _percent(text: str) -> float:
    value = float(text)
    if not 0 < value <= 100:
        raise argparse.ArgumentTypeError(f"{text!r}; expected a share of a core above 0 and up to 100")
    return value


class _Speaker:
    """Numbers frames and writes them."""

    def __init__(self, into: BinaryIO) -> None:
        self._into = into
        self._sequence = 0

    def say(self, frame: Frame) -> None:
        """Write a frame; one that is too long is replaced by a failure."""
        body = encode_frame(msgspec.structs.replace(frame, sequence=self._sequence))
        if len(body) > MAX_FRAME_BYTES:
            failure = Failure(
                TOOL, f"a frame of {len(body):,} bytes was not sent", f"at most {MAX_FRAME_BYTES:,} bytes",
                "See which program makes so many endpoints", partial=True,
            )  # fmt: skip
            shed = len(frame.tallies) + len(frame.events) + bool(frame.graph)
            body = encode_frame(Frame(VERSION, frame.sender, self._sequence, frame.time, failures=[failure], shed=shed))
        self._sequence += 1
        self._into.write(body)
        self._into.flush()


def _complain(text: str) -> None:
    sys.stderr.write(f"error: {text}\n")
    sys.stderr.flush()


def _stop(*_: object) -> None:
    raise SystemExit(0)


def observe(options: argparse.Namespace, speaker: _Speaker) -> None:
    """Observe until stopped."""
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    with far_peers(os.environ, options.domain):
        rclpy.init(args=[], domain_id=options.domain, signal_handler_options=SignalHandlerOptions.NO)
        node: Any = rclpy.create_node(
            f"{OWN[1:]}{os.getpid()}", namespace="/", enable_rosout=False, start_parameter_services=False
        )
    host = socket.gethostname()
    wakes: queue.SimpleQueue[tuple[int, str]] = queue.SimpleQueue()
    ends = ProcessEnds(lambda pid, how: wakes.put((pid, how)))
    publisher = _monitor_publisher(options, node, speaker, host)
    event = None
    try:
        event = GraphEvent(node, lambda: wakes.put(_CHANGED))
    except (OSError, AttributeError, RuntimeError) as error:
        speaker.say(_without_events(host, error))
    counters = CounterReader(folder_of(os.environ))
    counters.read(time.time())
    tap = Tap(node, options.tap, options.tap_budget, host) if options.tap else None
    lifecycles = Lifecycles(lambda service: StateClient(node, service))
    reported = ReportedTopics(node, host, Parameters(lambda name: NodeQuestions(node, name)))
    observation = Observation(host, GraphReader(node, host, lifecycles=lifecycles), counters, tap, reported)
    try:
        _Turns(observation, speaker, ends, wakes, tap, options.period, polled=event is None).run()
    finally:
        if event is not None:
            event.close()
        ends.close()
        counters.close()
        reported.close()
        if publisher is not None:
            publisher.close()
        node.destroy_node()
        rclpy.try_shutdown()


def _monitor_publisher(options: argparse.Namespace, node: Any, speaker: _Speaker, host: str) -> MonitorPublisher | None:
    """Publish what comes on standard input, where that was asked for."""
    if not (options.diagnostics or options.rated):
        return None
    publisher = MonitorPublisher(node, diagnostics=options.diagnostics, rated=options.rated)
    if publisher.failures:
        speaker.say(Frame(VERSION, f"{host}/{TOOL}", 0, time.time(), failures=publisher.failures))
    when_asked(0, publisher.publish, _complain)
    return publisher


def _without_events(host: str, error: Exception) -> Frame:
    failure = Failure(
        TOOL, f"changes of the graph are not reported by the middleware: {error}", "librcl.so, and a node of rclpy",
        "They are looked for once a period instead", partial=True,
    )  # fmt: skip
    return Frame(VERSION, f"{host}/{TOOL}", 0, time.time(), failures=[failure])


class _Turns:
    """What to do when: graph changes gathered, ends of processes at once, tallies once a period, taps each 40 ms."""

    def __init__(
        self, observation: Observation, speaker: _Speaker, ends: ProcessEnds,
        wakes: queue.SimpleQueue[tuple[int, str]],
        tap: Tap | None, period: float, *, polled: bool,
    ) -> None:  # fmt: skip
        self._observation = observation
        self._speaker = speaker
        self._ends = ends
        self._wakes = wakes
        self._tap = tap
        self._period = period
        self._polled = polled
        self._due = time.monotonic() + period
        self._settled: float | None = time.monotonic() + MEET_S
        self._asking = False
        self._look_due = 0.0
        self._attention = Attention(time.monotonic(), max(PAUSE_S, 2 * period))

    def run(self) -> None:
        """Go on until the process is stopped."""
        while True:
            now = time.monotonic()
            if self._settled is not None and now >= self._settled:
                self._settled = None
                self._say(self._observation.changed(time.time()))
            if now >= self._due:
                self._tell()
            if self._tap is not None:
                self._tap.drain()
            self._asking = self._observation.ask(now)
            with suppress(queue.Empty):
                self._wake(*self._wakes.get(timeout=self._left()))

    def _tell(self) -> None:
        self._due = max(self._due + self._period, time.monotonic() + self._period / 10)
        attentive = self._attention.turn(time.monotonic())
        frame, stale = self._observation.period(time.time(), self._period, attentive=attentive)
        self._speaker.say(frame)
        looks = self._polled and time.monotonic() >= self._look_due
        if looks:
            self._look_due = time.monotonic() + LOOK_S
        if stale or looks:
            self._settle()

    def _left(self) -> float:
        until = self._due if self._settled is None else min(self._due, self._settled)
        left = max(0.0, until - time.monotonic())
        if self._tap is not None and self._tap.active:
            return min(left, DRAIN_S)
        return min(left, ASK_S) if self._asking else left

    def _wake(self, pid: int, how: str) -> None:
        if pid:
            self._say(self._observation.ended(pid, time.time(), how))
        else:
            self._settle()

    def _settle(self) -> None:
        if self._settled is None:
            self._settled = time.monotonic() + (ASKING_SETTLE_S if self._asking else SETTLE_S)

    def _say(self, frame: Frame | None) -> None:
        if frame is not None:
            self._speaker.say(frame)
        if self._observation.unsettled:
            self._settle()
        for pid in self._observation.pids():
            self._ends.watch(pid)


def main(words: list[str]) -> int:
    """Run; return the exit code."""
    options = read_arguments(words)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, _stop)
    # What libraries print must not get between the frames.
    frames = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    try:
        observe(options, _Speaker(frames))
    except BrokenPipeError:
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), frames.fileno())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
