"""Publishes for the monitor with rclpy: diagnostics, and rated signals where roslens_msgs is there."""

from __future__ import annotations

import threading
from importlib import import_module
from typing import Any

import msgspec

from roslens.live.adapters.ros2 import TOOL
from roslens.model.acting.outgoing import Outgoing, RatedSignals, Status
from roslens.model.failure import Failure

DIAGNOSTICS = "/diagnostics"
_DEPTH = 10


class MonitorPublisher:
    """The publishers of one node.

    Attributes:
        failures: what cannot be published, and why.
    """

    def __init__(self, node: Any, *, diagnostics: bool, rated: str) -> None:
        """Publish on /diagnostics if ``diagnostics`` is set, and on the topic ``rated`` unless it is empty."""
        self.failures: list[Failure] = []
        self._lock = threading.Lock()
        self._closed = False
        self._diagnostics: Any = None
        self._rated: Any = None
        if diagnostics:
            self._diagnostics = self._publisher(node, "diagnostic_msgs", "DiagnosticArray", DIAGNOSTICS)
        if rated:
            self._rated = self._publisher(node, "roslens_msgs", "RatedSignals", rated)

    def _publisher(self, node: Any, package: str, name: str, topic: str) -> Any:
        try:
            return node.create_publisher(getattr(import_module(f"{package}.msg"), name), topic, _DEPTH)
        except Exception as error:  # noqa: BLE001 - of a package that is not there, not whole, or of a topic of another type
            self.failures.append(
                Failure(
                    TOOL, f"nothing is published on {topic}: {type(error).__name__}: {error}",
                    f"{package}/msg/{name}, and a topic of that type",
                    f"Build {package} in a workspace and source its setup file", partial=True,
                )
            )  # fmt: skip
            return None

    def publish(self, frame: Outgoing) -> None:
        """Publish what a frame holds; nothing after :meth:`close`."""
        with self._lock:
            if self._closed:
                return
            if frame.statuses is not None and self._diagnostics is not None:
                self._diagnostics.publish(diagnostic_array(frame.time, frame.statuses))
            if frame.rated is not None and self._rated is not None:
                self._rated.publish(rated_signals(frame.time, frame.rated))

    def close(self) -> None:
        """Publish no more; the publishers end with their node."""
        with self._lock:
            self._closed = True


def diagnostic_array(time: float, statuses: tuple[Status, ...]) -> Any:
    """Return a diagnostic_msgs.msg.DiagnosticArray stamped with seconds since the epoch."""
    messages: Any = import_module("diagnostic_msgs.msg")
    array = messages.DiagnosticArray()
    _stamp(array.header, time)
    array.status = [
        messages.DiagnosticStatus(
            level=bytes([one.level]), name=_text(one.name), message=_text(one.message),
            hardware_id=_text(one.hardware_id),
            values=[messages.KeyValue(key=_text(key), value=_text(value)) for key, value in one.values],
        )
        for one in statuses
    ]  # fmt: skip
    return array


def rated_signals(time: float, rated: RatedSignals) -> Any:
    """Return a roslens_msgs.msg.RatedSignals stamped with seconds since the epoch."""
    messages: Any = import_module("roslens_msgs.msg")
    message = messages.RatedSignals(
        monitor=_text(rated.monitor), complete=rated.complete, part=rated.part, parts=rated.parts,
        signals=[_filled(messages.RatedSignal, one) for one in rated.signals],
        connections=[_filled(messages.ConnectionStatistics, one) for one in rated.connections],
    )  # fmt: skip
    _stamp(message.header, time)
    return message


def _filled(kind: Any, value: msgspec.Struct) -> Any:
    pairs = ((name, getattr(value, name)) for name in value.__struct_fields__)
    return kind(**{name: _text(part) if isinstance(part, str) else part for name, part in pairs})


def _text(text: str) -> str:
    # A zero ends a string there, and half a surrogate is no UTF-8.
    return text.replace("\0", "\N{REPLACEMENT CHARACTER}").encode("utf-8", "replace").decode()


def _stamp(header: Any, time: float) -> None:
    whole, part = divmod(round(time * 1e9), 1_000_000_000)
    header.stamp.sec, header.stamp.nanosec = whole, part
