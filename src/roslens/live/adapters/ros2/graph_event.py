"""Waits until the graph changes, which rclpy does not offer: rcl's guard condition, through ctypes."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable
from typing import Any

_WAIT_NS = 200_000_000
_TIMEOUT = 2
_ROOM = 1024


class _WaitSet(ctypes.Structure):
    """Room for rcl's wait set, whose size differs between versions."""

    _fields_ = (("room", ctypes.c_byte * _ROOM),)


class _Allocator(ctypes.Structure):
    """rcutils_allocator_t: four functions and their state."""

    _fields_ = tuple((f"part{number}", ctypes.c_void_p) for number in range(5))


class GraphEvent:
    """Calls a function, in a thread of its own, each time the graph of a node changes.

    Args:
        node: of rclpy.
        changed: what to call.

    Raises:
        OSError: the library cannot be loaded.
        AttributeError: it or the node lacks a function that is needed.
        RuntimeError: the wait set cannot be made.
    """

    def __init__(self, node: Any, changed: Callable[[], None]) -> None:
        library = ctypes.CDLL("librcl.so")
        self._changed = changed
        self._set = _WaitSet()
        self._condition = self._prepare(library, node)
        self._library = library
        self._open = True
        self._thread = threading.Thread(target=self._watch, daemon=True, name="graph")
        self._thread.start()

    def _prepare(self, library: ctypes.CDLL, node: Any) -> int:
        library.rcl_node_get_graph_guard_condition.restype = ctypes.c_void_p
        library.rcl_node_get_graph_guard_condition.argtypes = [ctypes.c_void_p]
        library.rcl_get_zero_initialized_wait_set.restype = _WaitSet
        library.rcl_wait.argtypes = [ctypes.c_void_p, ctypes.c_int64]
        library.rcl_wait_set_clear.argtypes = library.rcl_wait_set_fini.argtypes = [ctypes.c_void_p]
        library.rcl_wait_set_add_guard_condition.argtypes = [ctypes.c_void_p] * 3
        library.rcl_wait_set_init.argtypes = [
            ctypes.c_void_p, *[ctypes.c_size_t] * 6, ctypes.c_void_p, _Allocator,
        ]  # fmt: skip
        utilities = ctypes.CDLL("librcutils.so")
        utilities.rcutils_get_default_allocator.restype = _Allocator
        condition: int | None = library.rcl_node_get_graph_guard_condition(node.handle.pointer)
        self._set = library.rcl_get_zero_initialized_wait_set()
        made = library.rcl_wait_set_init(
            ctypes.addressof(self._set), 0, 1, 0, 0, 0, 0, node.context.handle.pointer,
            utilities.rcutils_get_default_allocator(),
        )  # fmt: skip
        if made or not condition:
            raise RuntimeError(f"rcl_wait_set_init returned {made}")
        return condition

    def _watch(self) -> None:
        wait_set = ctypes.addressof(self._set)
        while self._open:
            self._library.rcl_wait_set_clear(wait_set)
            if self._library.rcl_wait_set_add_guard_condition(wait_set, self._condition, None):
                return
            result = self._library.rcl_wait(wait_set, _WAIT_NS)
            if result == 0 and self._open:
                self._changed()
            elif result not in (0, _TIMEOUT):
                return

    def close(self) -> None:
        """Stop waiting; call it before the node is destroyed."""
        self._open = False
        self._thread.join()
        self._library.rcl_wait_set_fini(ctypes.addressof(self._set))
