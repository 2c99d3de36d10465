"""The observers of ROS as sources of a session: which processes to start, and with which arguments."""

from __future__ import annotations

import select
import sys
from collections.abc import Callable, Mapping, Sequence

import msgspec

from roslens.children.safe_path import python_words
from roslens.live.adapters.child import Child, find_ros2_python, ros2_command
from roslens.live.publish.downlink import Downlink
from roslens.model.failure import Failure
from roslens.model.wire import Frame

_ROS1 = "from roslens.live.adapters.ros1.__main__ import main; sys.exit(main(sys.argv[1:]))"


class Publishes(msgspec.Struct, frozen=True):
    """What an observer publishes in ROS for the monitor.

    Attributes:
        diagnostics: diagnostic_msgs/DiagnosticArray on /diagnostics.
        rated: topic of roslens_msgs/RatedSignals; empty for none.
    """

    diagnostics: bool = False
    rated: str = ""


class ChildSource:
    """A process that observes, asked for its frames.

    Attributes:
        tool: which one it is, for messages.
        seeing: whether it has reported who is there, or that it cannot.
    """

    def __init__(
        self, tool: str, child: Child, *, steady: Callable[[], float], downlink: Downlink | None = None
    ) -> None:
        """Read ``child``; ``steady`` is a clock that never jumps, ``downlink`` leads to the child."""
        self.downlink = downlink
        self.tool = tool
        self.seeing = False
        self._child = child
        self._early: list[Frame | Failure] = []
        self._steady = steady

    def begin(self) -> None:
        """Start the process now instead of with the first poll, which then has what it reported meanwhile."""
        if not self._child.starts:
            self._early = self._child.poll(self._steady())

    def poll(self, seconds: float) -> list[Frame | Failure]:
        """Wait at most so long for the next frame, and return what came."""
        file = self._child.fileno()
        select.select([file] if file is not None else [], [], [], seconds)
        came = self._early + self._child.poll(self._steady())
        self._early = []
        self.seeing = self.seeing or any(map(_of_who_is_there, came))
        return came

    def descriptors(self) -> list[int]:
        """Return what becomes readable with the next frame."""
        file = self._child.fileno()
        return [] if file is None else [file]

    def end(self) -> None:
        """Ask the process to end."""
        self._child.end()

    def close(self) -> None:
        """End the process, and wait until it has."""
        self._child.close()


def _of_who_is_there(reported: Frame | Failure) -> bool:
    if isinstance(reported, Failure):
        return not reported.partial
    return reported.graph is not None or any(not one.partial for one in reported.failures)


def ros1_source(
    master: str, taps: Sequence[str], environment: Mapping[str, str], *, steady: Callable[[], float],
    publishes: Publishes | None = None,
) -> ChildSource:  # fmt: skip
    """Return what observes the ROS 1 system of ``master``; empty is that of the environment."""
    asked = [*(["--master", master] if master else []), *_taps(taps), *_published(publishes)]
    words = ("--statistics", "--parameters", "--reports", *asked)
    command = python_words(sys.executable, _ROS1, words, path=sys.path)
    return _source("ros1", command, environment, steady, publishes)


def ros2_source(
    python: str, domain: int | None, taps: Sequence[str], environment: Mapping[str, str], *,
    steady: Callable[[], float], publishes: Publishes | None = None,
) -> ChildSource:  # fmt: skip
    """Return what observes the ROS 2 system of a domain, with a Python in which rclpy is.

    Raises:
        UsageError: there is no such Python.
    """
    found = find_ros2_python(python, environment)
    words = [*(["--domain", str(domain)] if domain is not None else []), *_taps(taps), *_published(publishes)]
    return _source("ros2", ros2_command(found, words), environment, steady, publishes)


def _source(
    name: str, command: Sequence[str], environment: Mapping[str, str], steady: Callable[[], float],
    publishes: Publishes | None,
) -> ChildSource:  # fmt: skip
    downlink = Downlink() if publishes is not None else None
    return ChildSource(name, Child(name, command, environment, downlink), steady=steady, downlink=downlink)


def _published(publishes: Publishes | None) -> list[str]:
    if publishes is None:
        return []
    return [
        *(["--diagnostics"] if publishes.diagnostics else []),
        *(["--rated", publishes.rated] if publishes.rated else []),
    ]


def _taps(patterns: Sequence[str]) -> list[str]:
    return [word for pattern in patterns for word in ("--tap", pattern)]
