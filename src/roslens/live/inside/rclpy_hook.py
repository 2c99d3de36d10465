"""Counts what the nodes of this process publish and take with rclpy; their code stays as it is.

Where the preloaded library is in the process, it counts all that, and this only tells it when a thread turns to what it
does not see (``beside_library``). The rest is for where there was no compiler to build the library.

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

from .beside_library import UNSEEN, forgets, forgetting
from .rclpy_state import Hook
from .sequence import Sequence
from .slots import ANSWERED, CAPACITY, PUBLISHED, TAKEN, Slot

_OTHER_WORK = ("_take_timer", "_take_client", "_take_service", "_take_guard_condition", "_take_waitable")
_NO_NUMBER = 0xFFFFFFFFFFFFFFFF


class _Current(threading.local):
    """What the callback that runs in this thread was given: topic and time of taking; None is nothing."""

    given: tuple[str, int] | None = None


_CURRENT = _Current()


HOOK = Hook()
atexit.register(HOOK.close)
os.register_at_fork(after_in_child=HOOK.after_fork)


def _node_of(handle: Any) -> str:
    """Return the name of the node of a publisher or subscription from that of its logger; empty if it contains none."""
    named = getattr(handle, "get_logger_name", None)
    return "/" + named().replace(".", "/") if named is not None else ""


def _unexpected(function: Any, *names: str) -> str:
    """Return how a function differs from the one that can be replaced; empty if it does not."""
    code = getattr(function, "__code__", None)
    if code is None:
        return "is not there"
    if code.co_argcount != 2:
        return f"takes {code.co_argcount} arguments"
    missing = [name for name in names if name not in code.co_names]
    return f"does not call {missing[0]}" if missing else ""


def _replaceable(owner: Any, name: str, *names: str) -> Callable[..., Any] | None:
    """Return a method that is as expected; None, which is reported, where it is not."""
    function: Any = getattr(owner, name, None)
    wrong = _unexpected(function, *names)
    if wrong:
        HOOK.say(f"rclpy: not counting: {owner.__name__}.{name} {wrong}")
        return None
    return function  # type: ignore[no-any-return]  # rclpy is not here to be looked at


class _Arrivals:
    """The messages of one subscription, by publisher."""

    def __init__(self, subscription: Any) -> None:
        handle = subscription.handle
        self.topic: str = handle.get_topic_name()
        self._node = _node_of(handle)
        self._known: dict[bytes | None, tuple[Slot | None, Sequence | None]] = {}
        self._slots: list[Slot] = []
        HOOK.ends_with(subscription, self._slots)
        fields: Any = getattr(subscription.msg_type, "get_fields_and_field_types", dict)()
        self.stamped = not subscription.raw and fields.get("header") == "std_msgs/Header"
        self.slotted = self.stamped and hasattr(subscription.msg_type, "_header")

    def of(self, gid: bytes | None, now: int) -> tuple[Slot | None, Sequence | None]:
        """Return the slot of what a publisher publishes, and what knows which of it is lost."""
        found = self._known.get(gid)
        if found is None:
            if len(self._known) >= CAPACITY:
                self._forget_silent()
            slot = HOOK.slot(TAKEN, bytes(gid or b""), self.topic, self._node, now=now)
            if slot is not None:
                self._slots.append(slot)
            # Without an identifier the numbers of several publishers cannot be distinguished.
            found = self._known[gid] = (slot, Sequence() if gid else None)
        return found

    def _forget_silent(self) -> None:
        """Forget publishers whose slot was given to another, or that found none: each tool that ever published."""
        self._known = {gid: of for gid, of in self._known.items() if of[0] is not None and not of[0].left}
        self._slots[:] = [slot for slot in self._slots if not slot.left]


class _Handle:
    """Stands in for the handle of a subscription where a message is taken from it.

    ``with`` finds the handle's own methods in slots of these names, which spares two calls a message.
    """

    __slots__ = ("__enter__", "__exit__", "_handle", "take_message")

    def __init__(self, handle: Any, arrivals: _Arrivals) -> None:
        self._handle = handle
        self.__enter__ = handle.__enter__
        self.__exit__ = handle.__exit__
        self.take_message = _counted(handle.take_message, arrivals)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._handle, name)


def _age(message: Any, received: int) -> int | None:
    """Return how long after the stamp in its header a message was received; None without a stamp."""
    stamp = message.header.stamp
    return received - stamp.sec * 1_000_000_000 - stamp.nanosec if stamp.sec else None


def _slotted_age(message: Any, received: int) -> int | None:
    """Return the same where a class keeps its fields in slots: each property in front of one costs a call."""
    stamp = message._header._stamp  # noqa: SLF001 - see above
    return received - stamp._sec * 1_000_000_000 - stamp._nanosec if stamp._sec else None  # noqa: SLF001


def _counted(take: Callable[[Any, bool], Any], arrivals: _Arrivals) -> Callable[[Any, bool], Any]:
    """Return what takes a message and counts it; what is used for each message is in variables around it."""
    topic, stamped = arrivals.topic, arrivals.stamped
    age_of = _slotted_age if arrivals.slotted else _age
    current, time_ns = _CURRENT, time.time_ns
    last_gid: bytes | None = b"no publisher yet"
    arrived: Any = None
    sequence: Sequence | None = None

    def change(gid: bytes | None, now: int) -> None:
        nonlocal last_gid, arrived, sequence
        slot, sequence = arrivals.of(gid, now)
        arrived = slot.arrived if slot is not None else None
        last_gid = gid

    def count(message: Any, info: Any) -> None:
        now = time_ns()
        current.given = (topic, now)
        gid = info["publisher_gid"]["data"] if "publisher_gid" in info else None
        if gid != last_gid:
            change(gid, now)
        if arrived is None:
            return
        received = info["received_timestamp"] or now
        sent = info["source_timestamp"]
        latency = received - sent if sent else None
        age = age_of(message, received) if stamped else None
        size = len(message) if type(message) is bytes else -1
        arrived(now, received, latency, age, size, sequence and _followed(sequence, info, now))

    def take_message(kind: Any, raw: bool) -> Any:
        taken = take(kind, raw)
        if taken is not None:
            try:
                count(*taken)
            except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
                HOOK.stop(error)
        return taken

    return take_message


def _followed(sequence: Sequence, info: Any, now: int) -> Sequence | None:
    """Return what follows the numbers of a publisher, if that of a message brings news of losses."""
    number = info.get("publication_sequence_number", _NO_NUMBER)
    if number == sequence.following:
        sequence.following = number + 1
    elif number == _NO_NUMBER:
        return None
    else:
        sequence.feed(number, now)
    return sequence if sequence.touched else None


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
    forget = forgets()
    if forget is not None:
        for name in UNSEEN:
            if callable(getattr(executor, name, None)):
                HOOK.replace(executor, name, forgetting(getattr(executor, name), forget))
        HOOK.below = True
        return
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


def _departures(publisher: Any, now: int) -> Callable[[int, int], None]:
    """Return what counts the messages of a publisher; what is used for each message is in variables around it."""
    handle = publisher.handle
    topic: str = handle.get_topic_name()
    node = _node_of(handle)
    slot = HOOK.slot(PUBLISHED, b"", topic, node, now=now)
    slots = [slot] if slot is not None else []
    publisher.roslens_end = HOOK.ends_with(publisher, slots)
    departed = slot.arrived if slot is not None else None
    current = _CURRENT
    answers: dict[str, Slot | None] = {}
    asked = ""
    answered: Callable[[int, int], None] | None = None

    def ask(name: str, now: int) -> None:
        nonlocal asked, answered
        if name not in answers:
            answers[name] = HOOK.slot(ANSWERED, b"", topic, node, name, now)
        of = answers[name]
        asked, answered = name, of.answered if of is not None else None
        if of is not None and of not in slots:
            slots.append(of)

    def count(now: int, size: int) -> None:
        if departed is not None:
            departed(now, now, None, None, size, None)
        given = current.given
        if given is not None:
            name, taken = given
            if name != asked:
                ask(name, now)
            if answered is not None and now >= taken:
                answered(now, now - taken)

    return count


def _ending(destroy: Callable[[Any], None]) -> Callable[[Any], None]:
    """Return what destroys a publisher and gives its slots back."""

    @functools.wraps(destroy)
    def end_and_destroy(self: Any) -> None:
        try:
            end = getattr(self, "roslens_end", None)
            if end is not None:
                end()
        except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
            HOOK.stop(error)
        destroy(self)

    return end_and_destroy


def hook_publisher(module: ModuleType) -> None:
    """Count what the publishers of ``rclpy.publisher`` publish."""
    if HOOK.below or forgets() is not None:
        return
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
                count = self.roslens_counters
            except AttributeError:
                count = self.roslens_counters = _departures(self, now)
            count(now, len(msg) if type(msg) is bytes else -1)
        except Exception as error:  # noqa: BLE001 - whatever it is, the node shall not notice
            HOOK.stop(error)

    HOOK.replace(publisher_class, "publish", publish_and_count)
    destroy = getattr(publisher_class, "destroy", None)
    if callable(destroy):
        HOOK.replace(publisher_class, "destroy", _ending(destroy))
    HOOK.claim("published")
