"""Carries out orders in a process that has ROS: each in a thread of its own, so that none waits for another."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from importlib import import_module
from typing import Any

import msgspec

from roslens.live.act.ros import ActionError, Ros
from roslens.model.acting.action_kind import By, action_kind
from roslens.model.acting.order import VERSION, Order, Reply, Verb

_AT_ONCE = 16
_MOST_REPEATED = 50


class _Asked(msgspec.Struct, frozen=True):
    """An order, as the kinds of action see it."""

    id: str
    target: str
    arguments: Mapping[str, Any]
    repeat: Callable[[float, Callable[[], object]], None]


class Orders:
    """Takes orders and reports their results.

    Args:
        ros: to act in.
        say: where replies go; called in any thread, one at a time.
        steady: a clock that never jumps.
    """

    def __init__(self, ros: Ros, say: Callable[[Reply], None], steady: Callable[[], float] = time.monotonic) -> None:
        self._ros = ros
        self._say = say
        self._steady = steady
        self._pool = ThreadPoolExecutor(_AT_ONCE, "orders")
        self._lock = threading.Lock()
        self._repeated: dict[str, threading.Event] = {}

    def take(self, order: Order) -> None:
        """Begin to carry an order out; returns at once."""
        if order.verb is Verb.STOP:
            for one in list(self._repeated):
                self._end(one)
        elif order.verb is Verb.CLEAR:
            self._end(order.id)
        else:
            self._pool.submit(self._carry_out, order)

    def close(self) -> None:
        """End what repeats, and take no more."""
        for one in list(self._repeated):
            self._end(one)
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _carry_out(self, order: Order) -> None:
        began = self._steady()
        try:
            text, done = self._done(order), True
        except ActionError as error:
            text, done = str(error), False
        except Exception as error:  # noqa: BLE001 - whatever ROS raises is why the action failed
            text, done = f"{type(error).__name__}: {error}", False
        reply = Reply(VERSION, order.id, order.verb, done, text, self._steady() - began)
        with self._lock:
            self._say(reply)

    def _done(self, order: Order) -> str:
        kind = action_kind(order.kind)
        if kind is None or kind.by is not By.ROS:
            raise ActionError(f"{order.kind[:60]!r} is not an action that is carried out through ROS")
        if self._ros.generation not in kind.ros:
            raise ActionError(f"{order.kind} does not exist in ROS {self._ros.generation}")
        module = import_module(f"roslens.live.act.actions.{kind.key}")
        reported = kind.filled(order.arguments)
        asked = _Asked(order.id, order.target, reported, lambda every, again: self._repeat(order.id, every, again))
        if order.verb is Verb.PREPARE:
            module.prepare(self._ros, asked)
            return "ready"
        return str(module.act(self._ros, asked))

    def _repeat(self, key: str, every_s: float, again: Callable[[], object]) -> None:
        with self._lock:
            if len(self._repeated) >= _MOST_REPEATED:
                raise ActionError(f"{_MOST_REPEATED} actions repeat already", expected="fewer")
            ended = self._repeated[key] = threading.Event()

        def go_on() -> None:
            while not ended.wait(every_s):
                with suppress(Exception):  # the next one may pass; what became of the first was reported
                    again()

        threading.Thread(target=go_on, name=f"repeats {key}", daemon=True).start()

    def _end(self, key: str) -> None:
        with self._lock:
            if (ended := self._repeated.pop(key, None)) is not None:
                ended.set()
