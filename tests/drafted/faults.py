"""The kinds of faults that are put into the robot, and what a verdict about each may be about."""

from __future__ import annotations

import contextlib
import json
import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from wrong_ok.lines import Printed
from wrong_ok.scene import Scene

ROLES = ("scanner", "listener", "server", "client", "managed")


class Robot:
    """The nodes of a scene, by role, and what is wrong with them."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.wrong = scene.folder / "wrong"
        self.wrong.mkdir()
        self.nodes: dict[str, Printed] = {}
        for role in ROLES:
            self.start(role)

    def start(self, role: str, *words: str) -> None:
        """Start a node."""
        self.nodes[role] = self.scene.node(role, *words, WRONG=str(self.wrong))

    def pid(self, role: str) -> int:
        """Return the process of a node."""
        return self.nodes[role].process.pid

    def end(self, role: str) -> None:
        """Kill a node."""
        self.nodes[role].process.kill()
        self.nodes[role].process.wait()

    @contextlib.contextmanager
    def is_wrong(self, role: str, **what: Any) -> Iterator[None]:
        """Let this be wrong with a node."""
        self._write(role, what)
        yield
        self._write(role, {})

    def _write(self, role: str, what: dict[str, Any]) -> None:
        fresh = Path(f"{self.wrong / role}.new")
        fresh.write_text(json.dumps(what))
        fresh.replace(self.wrong / role)


Began = contextlib.AbstractContextManager[None]


class Kind(NamedTuple):
    """A kind of fault.

    Attributes:
        begin: puts it in, and takes it out at the end.
        about: what a verdict about it is about, as ``entity quantity``, or a part of either.
    """

    begin: Callable[[Robot], Began]
    about: tuple[str, ...]


def _wrong(role: str, **what: Any) -> Callable[[Robot], Began]:
    return lambda robot: robot.is_wrong(role, **what)


@contextlib.contextmanager
def _killed(robot: Robot, role: str) -> Iterator[None]:
    robot.end(role)
    yield
    robot.start(role)


@contextlib.contextmanager
def _stopped(robot: Robot) -> Iterator[None]:
    os.kill(robot.pid("scanner"), signal.SIGSTOP)
    yield
    os.kill(robot.pid("scanner"), signal.SIGCONT)


@contextlib.contextmanager
def _besides(robot: Robot, role: str, *words: str) -> Iterator[None]:
    second = robot.scene.node(role, *words, WRONG=str(robot.wrong))
    yield
    second.process.kill()
    second.process.wait()


@contextlib.contextmanager
def _elsewhere(robot: Robot) -> Iterator[None]:
    robot.end("scanner")
    robot.start("scanner", "scannner")
    yield
    robot.end("scanner")
    robot.start("scanner")


KINDS: dict[str, Kind] = {
    "rate halved": Kind(_wrong("scanner", half=1), ("topic:/imu rate",)),
    "a third not sent": Kind(_wrong("scanner", loss=0.33), ("topic:/imu rate",)),
    "1 s of silence": Kind(_wrong("scanner", mute=1), ("topic:/imu",)),
    "80 ms late": Kind(_wrong("scanner", late=0.08), ("topic:/imu age",)),
    "killed": Kind(lambda robot: _killed(robot, "scanner"), ("node:/scanner presence",)),
    "stopped": Kind(_stopped, ("node:/scanner", "topic:/imu")),
    "burns a core": Kind(_wrong("scanner", burn=0.9), ("node:/scanner cpu", "topic:/imu")),
    "memory grows": Kind(_wrong("scanner", leak=8), ("node:/scanner memory",)),
    "service 200 ms slower": Kind(_wrong("server", slow=0.2), ("service:/get",)),
    "server killed": Kind(lambda robot: _killed(robot, "server"), ("service:/get presence",)),
    "qualities that do not fit": Kind(lambda robot: _besides(robot, "strict"), ("topic:/imu misfits",)),
    "second publisher of another type": Kind(lambda robot: _besides(robot, "other"), ("topic:/imu misfits",)),
    "second publisher": Kind(lambda robot: _besides(robot, "scanner", "second"), ("topic:/imu publishers",)),
    "second node of one name": Kind(lambda robot: _besides(robot, "scanner"), ("node:/scanner",)),
    "parameter changed": Kind(_wrong("scanner", gain=9), ("parameter:/scanner/gain",)),
    "inactive": Kind(_wrong("managed", inactive=1), ("node:/managed lifecycle",)),
    "name misspelt": Kind(_elsewhere, ("node:/scanner presence",)),
    "subscriber takes every 26th message": Kind(_wrong("listener", slow=1.3), ("topic:/imu loss",)),
}
