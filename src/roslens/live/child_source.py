"""The observers of ROS as sources of a session: which processes to start, and with which arguments."""

from __future__ import annotations

import select
import sys
from collections.abc import Callable, Mapping, Sequence

from roslens.live.adapters.child import Child, find_ros2_python, ros2_command
from roslens.model.failure import Failure
from roslens.model.wire import Frame


class ChildSource:
    """A process that observes, asked for its frames."""

    def __init__(self, child: Child, *, steady: Callable[[], float]) -> None:
        """Read ``child``; ``steady`` is a clock that never jumps."""
        self._child = child
        self._steady = steady

    def poll(self, seconds: float) -> list[Frame | Failure]:
        """Wait at most so long for the next frame, and return what came."""
        file = self._child.fileno()
        select.select([file] if file is not None else [], [], [], seconds)
        return self._child.poll(self._steady())

    def descriptors(self) -> list[int]:
        """Return what becomes readable with the next frame."""
        file = self._child.fileno()
        return [] if file is None else [file]

    def close(self) -> None:
        """End the process."""
        self._child.close()


def ros1_source(
    master: str, taps: Sequence[str], environment: Mapping[str, str], *, steady: Callable[[], float]
) -> ChildSource:
    """Return what observes the ROS 1 system of ``master``; empty is that of the environment."""
    words = ["--statistics", *(["--master", master] if master else []), *_taps(taps)]
    command = [sys.executable, "-m", "roslens.live.adapters.ros1", *words]
    return ChildSource(Child("ros1", command, environment), steady=steady)


def ros2_source(
    python: str, domain: int | None, taps: Sequence[str], environment: Mapping[str, str], *, steady: Callable[[], float]
) -> ChildSource:
    """Return what observes the ROS 2 system of a domain, with a Python in which rclpy is.

    Raises:
        UsageError: there is no such Python.
    """
    found = find_ros2_python(python, environment)
    words = [*(["--domain", str(domain)] if domain is not None else []), *_taps(taps)]
    return ChildSource(Child("ros2", ros2_command(found, words), environment), steady=steady)


def _taps(patterns: Sequence[str]) -> list[str]:
    return [word for pattern in patterns for word in ("--tap", pattern)]
