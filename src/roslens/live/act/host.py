"""What actions need of a host: its processes, and the commands that it allows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from roslens.model.acting.host_request import HostRequest


class Known(Protocol):
    """A process as it was started; see :class:`roslens.live.agent.process_record.Recorded`."""

    @property
    def pid(self) -> int:
        """Its number."""

    @property
    def supervisor(self) -> str:
        """Name of what started it, where that starts again what ends."""

    @property
    def parent(self) -> int:
        """Number of the process that started it."""


class Host(Protocol):
    """A host, seen by who acts on it. Methods raise :class:`~roslens.live.act.ros.ActionError` with the reason."""

    def process(self, request: HostRequest) -> Known:
        """Return the process that a request is about, which may be gone."""

    def alive(self, process: Known) -> bool:
        """Whether that very process is there."""

    def signal(self, process: Known, number: int) -> None:
        """Send a signal to that very process; nothing where it is gone."""

    def ends(self, process: Known, within_s: float) -> bool:
        """Wait until it has ended; return whether it has."""

    def comes_back(self, process: Known, within_s: float) -> int:
        """Wait until the same command has been started again; return the id of the process, 0 for none."""

    def start(self, process: Known, node: str) -> int:
        """Start it as it was started before; return the number of the process."""

    def run(self, name: str) -> str:
        """Run a command of the allow-list, and return how it ended."""


class Carrying(Protocol):
    """A kind of action on a host."""

    def act(self, host: Host, request: HostRequest) -> str:
        """Carry it out, and return a description of what was done."""


def seconds(arguments: Mapping[str, Any], name: str, default: float) -> float:
    """Return a duration of the arguments, within what makes sense."""
    value = arguments.get(name, default)
    return min(max(float(value), 0.0), 60.0) if isinstance(value, (int, float)) else default
