"""A task on its way through workers, until each of its steps is done or dead."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.plugins.frames import LOADING, Answer, Began, Gave, Order, Step, Task, frame


class Death(msgspec.Struct, frozen=True):
    """How a worker ended: what it was at, why, and what it printed last."""

    at: Began | None
    why: str
    output: str


class Job:
    """A task, what came back for it, and how workers died on it."""

    def __init__(self, task: Task, *, plugins: Sequence[str], home: str = "") -> None:
        """Take the task, the plug-ins it calls, and the name of the worker it wants to run in again."""
        self.task = task
        self.plugins = tuple(plugins)
        self.home = home
        self.done: set[Step] = set()
        self.dead: set[Step] = set()
        self.answers: list[Answer] = []
        self.deaths: list[Death] = []
        self.given_up: set[str] = set()

    def order(self) -> bytes:
        """Return the frame that asks a worker for what is left."""
        return frame(Order(self.task, frozenset(self.done), frozenset(self.dead)))

    def receive(self, answer: Answer) -> None:
        """Keep an answer."""
        if isinstance(answer, Gave) and answer.over:
            self.done.add(answer.step)
        self.answers.append(answer)

    def died(self, death: Death) -> None:
        """Keep how a worker died on this task."""
        self.deaths.append(death)
        if death.at is not None:
            self.dead.add(death.at.step)

    def give_up(self, plugin: str) -> None:
        """Call no further hook of a plug-in."""
        if plugin in self.plugins and plugin not in self.given_up:
            self.given_up.add(plugin)
            self.dead.add(Step(plugin, LOADING))
