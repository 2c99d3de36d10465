"""Receives topics of ROS 2 that match patterns, as bytes, for what stores them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from roslens.intake.bounded_file import read_bounded
from roslens.judge.patterns.pattern import Pattern
from roslens.live.act.keeping import Topic
from roslens.live.act.ros import ActionError
from roslens.live.adapters.ros2.fields import interface

LOOK_S = 1.0
_DEPTH = 100
_MOST_TOPICS = 200
_MOST_BYTES = 200_000
_LINE = "=" * 80
_BUILT_IN = {
    "bool", "byte", "char", "float32", "float64", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64",
    "uint64", "string", "wstring",
}  # fmt: skip


class Listening:
    """Subscribes to every topic that matches, from a thread of its own that looks for new ones."""

    def __init__(self, node: Any, patterns: Sequence[str], received: Callable[[Topic, bytes], None]) -> None:
        """Receive topics that match a pattern.

        Raises:
            ActionError: a pattern is none.
        """
        try:
            self._patterns = [Pattern.parse(one) for one in patterns]
        except ValueError as error:
            raise ActionError(str(error), expected="patterns of topics") from None
        self._node = node
        self._received = received
        self._subscribed: dict[str, Any] = {}
        self._closed = threading.Event()
        self.look()
        threading.Thread(target=self._run, name="listening", daemon=True).start()

    def look(self) -> None:
        """Subscribe to what is new."""
        for name, types in self._node.get_topic_names_and_types():
            if name in self._subscribed or len(self._subscribed) >= _MOST_TOPICS or len(types) != 1:
                continue
            if any(one.matches(name) for one in self._patterns):
                self._subscribed[name] = self._subscribe(name, types[0])

    def close(self) -> None:
        """Stop receiving; subscriptions end with their node."""
        self._closed.set()

    def _run(self) -> None:
        while not self._closed.wait(LOOK_S):
            with suppress(Exception):  # of a topic that goes just now; the next look tries again
                self.look()

    def _subscribe(self, name: str, type_: str) -> Any:
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        try:
            kind = interface(type_, "msg")
        except ActionError:
            return None
        offered = [one.qos_profile for one in self._node.get_publishers_info_by_topic(name)]
        reliable = offered and all(one.reliability == ReliabilityPolicy.RELIABLE for one in offered)
        latched = offered and all(one.durability == DurabilityPolicy.TRANSIENT_LOCAL for one in offered)
        profile = QoSProfile(
            depth=_DEPTH,
            reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
        )
        topic = Topic(name, type_, "ros2msg", definition(type_), "cdr")
        return self._node.create_subscription(kind, name, lambda body: self._received(topic, body), profile, raw=True)


def definition(type_: str) -> str:
    """Return the definition of a message type with those of all that it holds; empty where there is no file of it."""
    texts: dict[str, str] = {}
    waiting = [type_]
    while waiting:
        one = waiting.pop(0)
        if one in texts:
            continue
        package, _, name = one.partition("/msg/")
        text = _file(package, name)
        if text is None:
            return ""
        texts[one] = text
        waiting += _held(text, package)
    parts = [texts.pop(type_)]
    parts += [f"{_LINE}\nMSG: {one.replace('/msg/', '/')}\n{text}" for one, text in texts.items()]
    return "\n".join(parts)


def _file(package: str, name: str) -> str | None:
    try:
        share = import_module("ament_index_python.packages").get_package_share_directory
        place = Path(share(package)) / "msg" / f"{name}.msg"
        return read_bounded(place, _MOST_BYTES).decode("utf-8", "replace")
    except (ImportError, OSError, LookupError, ValueError):
        return None


def _held(text: str, package: str) -> list[str]:
    """Return the types of the fields in a definition that are messages themselves."""
    found = []
    for line in text.splitlines():
        words = line.partition("#")[0].split()
        if len(words) < 2 or "=" in line.partition("#")[0].split("'")[0].split('"')[0]:
            continue
        type_ = words[0].partition("[")[0].partition("<")[0]
        if type_ in _BUILT_IN:
            continue
        owner, _, name = type_.rpartition("/")
        found.append(f"{owner.removesuffix('/msg') or package}/msg/{name}")
    return found
