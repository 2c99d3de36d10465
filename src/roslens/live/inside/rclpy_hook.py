"""Counts what the nodes of this process publish and take with rclpy; their code stays as it is.

``Executor._take_subscription`` and ``Publisher.publish`` are replaced by functions that call them and count. Both are
looked at first; where they are not as expected nothing is replaced, and the header of the counter file says why. An
error in the counting ends it for the whole process, never the node.

Limits: the events executor takes messages without Python and is not seen. A message published by a timer, a service or
a thread of its own answers nothing; one published between two calls of ``spin_once`` answers what the first of them
took.
"""

from __future__ import annotations

import atexit
import functools
import os
import threading
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

from .sequence import Sequence
from .slots import ANSWERED, PUBLISHED, TAKEN, CounterFile, Slot, folder_of

_OTHER_WORK = ("_take_timer", "_take_client", "_take_service", "_take_guard_condition", "_take_waitable")
_NO_NUMBER = 0xFFFFFFFFFFFFFFFF
_CLAIM = "ROSLENS_RCLPY_HOOK"
"""Tells the preloaded library, where there is one, which messages of which process are counted here and not by it."""


class _Current(threading.local):
    """What the callback that runs in this thread was given: topic and time of taking; None is nothing."""

    given: tuple[str, int] | None = None


_CURRENT = _Current()


class _Hook:
    """The state of the hook in this process."""

    def __init__(self) -> None:
        self.counters: CounterFile | None = None
        self.begun = False
        self.claimed = ""
        self.undo: list[tuple[Any, str, Any]] = []

    def open(self) -> CounterFile:
        """Return the counter file, made when it is first asked for."""
        if self.counters is None:
            self.counters = CounterFile(folder_of(os.environ))
        return self.counters

    def slot(self, kind: int, gid: bytes, topic: str, node: str, other: str = "", now: int = 0) -> Slot | None:
        """Return a slot of the counter file."""
        self.begun = True
        return self.open().slot(kind, gid, topic, node, other, now)

    def replace(self, owner: Any, name: str, function: Any) -> None:
        """Put a function in the place of one that ``stop`` puts back."""
        self.undo.append((owner, name, getattr(owner, name)))
        setattr(owner, name, function)

    def claim(self, direction: str) -> None:
        """Tell the preloaded library to leave messages of a direction, "taken" or "published", to this hook."""
        self.claimed += f" {direction}" if direction else ""
        os.environ[_CLAIM] = f"{os.getpid()}{self.claimed}"

    def leave(self) -> None:
        """Tell the preloaded library that nothing is counted here."""
        self.claimed = ""
        os.environ.pop(_CLAIM, None)

    def say(self, state: str) -> None:
        """Write the state of the hook where readers see it."""
        self.open().say(state)

    def stop(self, error: Exception) -> None:
        """Take the hook out after an error in it."""
        for owner, name, function in self.undo:
            setattr(owner, name, function)
        self.undo = []
        self.leave()
        if self.counters is not None:
            self.counters.fault()
            self.counters.say(f"rclpy: stopped after {type(error).__name__}: {error}")

    def close(self) -> None:
        """Take the counter file away at the end of the process."""
        if self.counters is not None:
            self.counters.close()

    def after_fork(self) -> None:
        """Leave the file to the parent. A child that had counted before would count into it: it counts no more."""
        if self.counters is not None:
            self.counters.release()
            self.counters = None
        if self.begun:
            for owner, name, function in self.undo:
                setattr(owner, name, function)
            self.undo = []
            self.leave()
        elif self.claimed:
            self.claim("")


HOOK = _Hook()
atexit.register(HOOK.close)
os.register_at_fork(after_in_child=HOOK.after_fork)


def _node_of(handle: Any) -> str:
    """Return the name of the node of a publisher or subscription from that of its logger; empty if it tells none."""
    named = getattr(handle, "get_logger_name", None)
    return "/" + named().replace(".", "/") if named is not None else ""


def _unexpected(function: Any, *names: str) -> str:
    """Say in what a function differs from the one that can be replaced; empty if in nothing."""
    code = getattr(function, "__code__", None)
    if code is None:
        return "is not there"
    if code.co_argcount != 2:
        return f"takes {code.co_argcount} arguments"
    missing = [name for name in names if name not in code.co_names]
    return f"does not call {missing[0]}" if missing else ""


def _replaceable(owner: Any, name: str, *names: str) -> Callable[..., Any] | None:
    """Return a method that is as expected; None, with what it is told to readers, where it is not."""
    function: Any = getattr(owner, name, None)
    wrong = _unexpected(function, *names)
    if wrong:
        HOOK.say(f"rclpy: not counting: {owner.__name__}.{name} {wrong}")
        return None
    return function  # type: ignore[no-any-return]  # rclpy is not here to be looked at


class _Arrivals:
    """Counts the messages of one subscription, by publisher."""

    __slots__ = ("_gid", "_known", "_node", "_sequence", "_slot", "_stamped", "_topic")

    def __init__(self, subscription: Any) -> None:
        handle = subscription.handle
        self._topic: str = handle.get_topic_name()
        self._node = _node_of(handle)
        fields: Any = getattr(subscription.msg_type, "get_fields_and_field_types", dict)()
        self._stamped = not subscription.raw and fields.get("header") == "std_msgs/Header"
        self._known: dict[bytes | None, tuple[Slot | None, Sequence | None]] = {}
        self._gid: bytes | None = b"no publisher yet"
        self._slot: Slot | None = None
        self._sequence: Sequence | None = None

    def count(self, message: Any, info: Any) -> None:
        """Count a message that was taken with this information."""
        now = time.time_ns()
        _CURRENT.given = (self._topic, now)
        gid = info["publisher_gid"]["data"] if "publisher_gid" in info else None
        slot, sequence = (self._slot, self._sequence) if gid == self._gid else self._of(gid, now)
        if slot is None:
            return
        received = info["received_timestamp"] or now
        sent = info["source_timestamp"]
        if sequence is not None:
            number = info.get("publication_sequence_number", _NO_NUMBER)
            if number == sequence.following:
                sequence.following = number + 1
            elif number == _NO_NUMBER:
                sequence = None
            else:
                sequence.feed(number, now)
        age = None
        if self._stamped:
            stamp = message.header.stamp
            seconds = stamp.sec
            if seconds:
                age = received - seconds * 1_000_000_000 - stamp.nanosec
        size = len(message) if type(message) is bytes else -1
        slot.arrived(now, received, received - sent if sent else None, age, size, sequence)

    def _of(self, gid: bytes | None, now: int) -> tuple[Slot | None, Sequence | None]:
        found = self._known.get(gid)
        if found is None:
            slot = HOOK.slot(TAKEN, bytes(gid or b""), self._topic, self._node, now=now)
            # Without an identifier the numbers of several publishers cannot be told apart.
            found = self._known[gid] = (slot, Sequence() if gid else None)
        self._gid, (self._slot, self._sequence) = gid, found
        return found


class _Handle:
    """Stands in for the handle of a subscription where a message is taken from it.

    ``with`` finds the handle's own methods in slots of these names, which spares two calls a message.
    """

    __slots__ = ("__enter__", "__exit__", "_handle", "take_message")

    def __init__(self, handle: Any, arrivals: _Arrivals) -> None:
        self._handle = handle
        self.__enter__ = handle.__enter__
        self.__exit__ = handle.__exit__
        self.take_message = _counted(handle.take_message, arrivals.count)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._handle, name)


def _counted(take: Callable[[Any, bool], Any], count: Callable[[Any, Any], None]) -> Callable[[Any, bool], Any]:
    def take_message(kind: Any, raw: bool) -> Any:
        taken = take(kind, raw)
        if taken is not None:
            try:
                message, info = taken
                count(message, info)
            except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
                HOOK.stop(error)
        return taken

    return take_message


class _Subscription:
    """Stands in for a subscription where a message is taken from it."""

    __slots__ = ("_callback_type", "_subscription", "handle", "msg_type", "raw")

    def __init__(self, subscription: Any) -> None:
        self._subscription = subscription
        self._callback_type = getattr(subscription, "_callback_type", None)
        self.handle = _Handle(subscription.handle, _Arrivals(subscription))
        self.msg_type = subscription.msg_type
        self.raw = subscription.raw

    @property
    def callback(self) -> Any:
        """The callback, which may have been exchanged since."""
        return self._subscription.callback

    def __getattr__(self, name: str) -> Any:
        return getattr(self._subscription, name)


def _stand_in(subscription: Any) -> Any:
    """Return what stands in for a subscription from now on; itself after an error."""
    try:
        subscription.roslens_counters = stand_in = _Subscription(subscription)
    except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
        HOOK.stop(error)
        return subscription
    return stand_in


def hook_executor(module: ModuleType) -> None:
    """Count what the executors of ``rclpy.executors`` take."""
    executor = module.Executor
    take = _replaceable(executor, "_take_subscription", "handle", "take_message")
    if take is None:
        return

    @functools.wraps(take)
    def take_and_count(self: Any, subscription: Any) -> Any:
        try:
            stand_in = subscription.roslens_counters
        except AttributeError:
            stand_in = _stand_in(subscription)
        return take(self, stand_in)

    HOOK.replace(executor, "_take_subscription", take_and_count)
    for name in _OTHER_WORK:
        if callable(getattr(executor, name, None)):
            HOOK.replace(executor, name, _answering_nothing(getattr(executor, name)))
    HOOK.claim("taken")
    HOOK.say("rclpy: counting")


def _answering_nothing(take: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(take)
    def forget_and_take(self: Any, entity: Any) -> Any:
        _CURRENT.given = None
        return take(self, entity)

    return forget_and_take


class _Departures:
    """Counts the messages of one publisher."""

    __slots__ = ("_answers", "_node", "_slot", "_topic")

    def __init__(self, publisher: Any, now: int) -> None:
        handle = publisher.handle
        self._topic: str = handle.get_topic_name()
        self._node = _node_of(handle)
        self._slot = HOOK.slot(PUBLISHED, b"", self._topic, self._node, now=now)
        self._answers: dict[str, Slot | None] = {}

    def count(self, now: int, size: int) -> None:
        """Count a message published at ``now``."""
        slot = self._slot
        if slot is not None:
            slot.arrived(now, now, None, None, size, None)
        given = _CURRENT.given
        if given is not None:
            topic, taken = given
            try:
                slot = self._answers[topic]
            except KeyError:
                slot = self._answers[topic] = HOOK.slot(ANSWERED, b"", self._topic, self._node, topic, now)
            if slot is not None and now >= taken:
                slot.answered(now, now - taken)


def hook_publisher(module: ModuleType) -> None:
    """Count what the publishers of ``rclpy.publisher`` publish."""
    publisher_class = module.Publisher
    publish = _replaceable(publisher_class, "publish", "handle", "publish")
    if publish is None:
        return

    @functools.wraps(publish)
    def publish_and_count(self: Any, msg: Any) -> None:
        now = time.time_ns()
        publish(self, msg)
        if not HOOK.undo:  # a method that was bound while the hook was in
            return
        try:
            try:
                departures = self.roslens_counters
            except AttributeError:
                departures = self.roslens_counters = _Departures(self, now)
            departures.count(now, len(msg) if type(msg) is bytes else -1)
        except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
            HOOK.stop(error)

    HOOK.replace(publisher_class, "publish", publish_and_count)
    HOOK.claim("published")
