"""What actions need of a ROS system: one protocol, which each generation of ROS fulfils in a process of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from roslens.model.errors import RoslensError


class ActionError(RoslensError):
    """An action that could not be carried out; the text states the reason, for the journal."""


class Ros(Protocol):
    """A running ROS system, seen by who acts in it. All methods raise :class:`ActionError` with the reason.

    Attributes:
        generation: 1 or 2.
    """

    generation: int

    def advertise(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> None:
        """Get ready to publish at once; looks whether the type is known and the fields fit."""

    def publish(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> int:
        """Publish a message and return how many subscribers there are."""

    def meet(self, service: str, type_: str, fields: Mapping[str, Any]) -> None:
        """Get ready to call a service; looks whether the type is known and the fields fit."""

    def call(self, service: str, type_: str, fields: Mapping[str, Any], timeout_s: float) -> Mapping[str, Any]:
        """Call a service and return the fields of its answer."""

    def set_parameter(self, node: str, name: str, value: Any, timeout_s: float) -> None:
        """Set a parameter."""

    def ready_to_log(self) -> None:
        """Prepare to publish on /rosout."""

    def log(self, level: str, text: str) -> None:
        """Publish a text on /rosout; ``level`` is info, warning or error."""

    def record(self, patterns: tuple[str, ...], before_s: float, path: str, after_s: float) -> str:
        """Write what was said in the last ``before_s`` and in the next ``after_s``; return what was written.

        Without a ``path`` it only begins to keep what is said.
        """


class Asked(Protocol):
    """One action that is asked for, with what lasts longer than it."""

    @property
    def id(self) -> str:
        """Of the decision."""

    @property
    def target(self) -> str:
        """Name of what it is done to."""

    @property
    def arguments(self) -> Mapping[str, Any]:
        """Its arguments, defaults filled in."""

    def repeat(self, every_s: float, again: Callable[[], object]) -> None:
        """Do something again and again until what the action was done about is gone."""
