"""Callbacks that a Python file hands over to rclpy, rospy and libraries on them, and what these reach by calls."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec
from tree_sitter import Node

from roslens.source.rules.calls import arguments, function_around, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonFunctions, python_functions
from roslens.source.rules.flow.summary import CallbackKind, Registration, Way, ways


class _Slot(msgspec.Struct, frozen=True):
    """An argument that is a callback: its place, its name and what calls it."""

    kind: CallbackKind
    place: int | None
    name: str


_GOALS = (
    _Slot(CallbackKind.GOAL, None, "goal_callback"),
    _Slot(CallbackKind.CANCEL, None, "cancel_callback"),
    _Slot(CallbackKind.ACCEPTED, None, "handle_accepted_callback"),
)
_ROS2: Mapping[str, Sequence[_Slot]] = {
    "create_subscription": (_Slot(CallbackKind.SUBSCRIPTION, 2, "callback"),),
    "create_timer": (_Slot(CallbackKind.TIMER, 1, "callback"),),
    "create_service": (_Slot(CallbackKind.SERVICE, 2, "callback"),),
    "create_guard_condition": (_Slot(CallbackKind.OTHER, 0, "callback"),),
    "add_on_set_parameters_callback": (_Slot(CallbackKind.PARAMETERS, 0, "callback"),),
    "set_parameters_callback": (_Slot(CallbackKind.PARAMETERS, 0, "callback"),),
    "add_post_set_parameters_callback": (_Slot(CallbackKind.OTHER, 0, "callback"),),
    "add_pre_set_parameters_callback": (_Slot(CallbackKind.OTHER, 0, "callback"),),
    "add_done_callback": (_Slot(CallbackKind.DONE, 0, "callback"),),
    "send_goal_async": (_Slot(CallbackKind.FEEDBACK, 1, "feedback_callback"),),
    "ActionServer": (_Slot(CallbackKind.EXECUTE, 3, "execute_callback"), *_GOALS),
}
_ROS1: Mapping[str, Sequence[_Slot]] = {
    "Subscriber": (_Slot(CallbackKind.SUBSCRIPTION, 2, "callback"),),
    "Timer": (_Slot(CallbackKind.TIMER, 1, "callback"),),
    "Service": (_Slot(CallbackKind.SERVICE, 2, "handler"),),
    "SimpleActionServer": (_Slot(CallbackKind.EXECUTE, 2, "execute_cb"),),
}
_BOTH: Mapping[str, Sequence[_Slot]] = {"registerCallback": (_Slot(CallbackKind.OTHER, 0, "cb"),)}
_WORDS = frozenset(one.encode() for one in (*_ROS1, *_ROS2, *_BOTH))
_ROSPY = frozenset({"Subscriber", "Timer", "Service"})
_THREADS = ("threading.Timer", "Thread", "threading.Thread")


class PythonCallbacks:
    """The callbacks of a file.

    Attributes:
        functions: of the file.
        registrations: of callbacks, in order.
        unfollowed: what is handed over in the default group of a node and is defined elsewhere.
    """

    def __init__(self, view: FileView) -> None:
        """Collect what a file registers."""
        self.functions: PythonFunctions = python_functions(view)
        self._view = view
        self.unfollowed: list[Node] = []
        self.registrations: tuple[Registration, ...] = tuple(self._registered())
        self._ways = ways(self.registrations, self.functions.callees)

    def ways_to(self, node: Node) -> Sequence[Way]:
        """Return the ways from callbacks to the function in which a node stands."""
        around = function_around(node)
        return self._ways.get(around.id, ()) if around is not None else ()

    def reached_from(self, registration: Registration) -> Iterator[Node]:
        """Yield the functions of the file that a callback reaches, itself first."""
        for known in self._ways.values():
            for way in known:
                if way.registration is registration:
                    yield way.functions[-1]

    def _registered(self) -> Iterator[Registration]:
        is_ros2 = b"rclpy" in self._view.words
        for call in self.functions.calls:
            callee = self._view.text(call.child_by_field_name("function"))
            name = callee.rpartition(".")[2]
            slots: Sequence[_Slot]
            if name in _ROS2 and is_ros2:
                slots, is_ros1 = _ROS2[name], False
            elif name in _ROS1 and callee not in _THREADS and self._is_rospy(callee, name):
                slots, is_ros1 = _ROS1[name], True
            else:
                slots, is_ros1 = _BOTH.get(name, ()), not is_ros2
            for slot in slots:
                yield from self._of_slot(call, slot, is_ros1=is_ros1)

    def _is_rospy(self, callee: str, name: str) -> bool:
        if name not in _ROSPY:
            return True
        return callee.startswith("rospy.") or (callee == name and b"from rospy import" in self._view.code)

    def _of_slot(self, call: Node, slot: _Slot, *, is_ros1: bool) -> Iterator[Registration]:
        given = keywords(call, self._view).get(slot.name)
        if given is None and slot.place is not None:
            placed = arguments(call)
            whole = not any(one.type == "list_splat" for one in placed[: slot.place + 1])
            given = placed[slot.place] if whole and len(placed) > slot.place else None
        if given is None:
            return
        targets = self.functions.meant(given)
        for target in targets:
            yield Registration(slot.kind, call, given, target, is_ros1)
        if not targets and not is_ros1 and "callback_group" not in keywords(call, self._view):
            self.unfollowed.append(given)


def python_callbacks(view: FileView) -> PythonCallbacks | None:
    """Return the callbacks of a file, read when a rule first asks; None where it registers none."""
    if PythonCallbacks not in view.kept:
        view.kept[PythonCallbacks] = None if _WORDS.isdisjoint(view.words) else PythonCallbacks(view)
    known = view.kept[PythonCallbacks]
    return known if isinstance(known, PythonCallbacks) else None


def ways_to(node: Node, view: FileView) -> Sequence[Way]:
    """Return the ways from callbacks that a file registers to the function in which a node stands."""
    known = python_callbacks(view)
    return () if known is None else known.ways_to(node)
