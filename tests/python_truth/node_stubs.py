"""Modules that stand in for rclpy, std_msgs and an unknown module while a made-up node runs: they record what it makes.

What the unknown module ``outside`` answers is drawn from a seed: ``ask()`` a truth value, ``number()`` a small number,
``text()`` a word; ``risky()`` may raise, ``context()`` is a context manager. A program calls ``left()`` before it
leaves a function that makes endpoints: that somebody gives up early, or that something raises, is not the usual way of
a node, and what is not made then is not held against the evaluation.
"""

from __future__ import annotations

import contextlib
import random
import sys
from collections.abc import Callable, Iterator
from types import FrameType, ModuleType
from typing import Any

import msgspec

MOST_ANSWERS = 100
MOST_LINES = 3000
WORDS = ("north", "south", "odom", "x")


class Made(msgspec.Struct, frozen=True):
    """An endpoint or parameter that a run made: where, as what, its name, and its quality of service if it has one."""

    line: int
    role: str
    name: str
    depth: int = 0
    reliability: str = ""
    durability: str = ""


class Run(msgspec.Struct, frozen=True):
    """What one run made, whether it ended normally, and whether a function was left early."""

    made: tuple[Made, ...]
    error: str = ""
    left: bool = False


class _Stop(BaseException):
    """Ends a run that asks for ever."""


class _Policy:
    def __init__(self, name: str) -> None:
        self.name = name


class _Policies:
    def __init__(self, *names: str) -> None:
        for name in names:
            setattr(self, name.upper(), _Policy(name))


class QoSProfile:
    """Holds depth and policies, as that of rclpy."""

    def __init__(self, *, depth: int = 0, reliability: Any = None, durability: Any = None, history: Any = None) -> None:
        self.depth = depth
        self.reliability = reliability or _Policy("reliable")
        self.durability = durability or _Policy("volatile")
        self.history = history


class _Recorder:
    """Answers questions by a seed and collects what is made."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.seed = seed
        self.made: list[Made] = []
        self.answers = 0
        self.left = False

    def count(self) -> None:
        self.answers += 1
        if self.answers > MOST_ANSWERS:
            raise _Stop

    def ask(self) -> bool:
        self.count()
        if self.seed < 2 and self.answers < 8:
            return bool(self.seed)
        return self.draw.random() < 0.5

    def number(self) -> int:
        self.count()
        return self.draw.randrange(4)

    def text(self) -> str:
        self.count()
        return self.draw.choice(WORDS)

    def risky(self) -> int:
        self.count()
        if self.ask():
            self.left = True
            raise RuntimeError("risky")
        return 1

    @contextlib.contextmanager
    def context(self) -> Iterator[str]:
        self.count()
        yield self.draw.choice(WORDS)

    def leave(self) -> None:
        self.left = True

    def make(self, frame: FrameType, role: str, name: str, qos: Any = None) -> None:
        if not isinstance(name, str):
            raise TypeError("a name is a text")
        if isinstance(qos, QoSProfile):
            self.made.append(Made(frame.f_lineno, role, name, qos.depth, qos.reliability.name, qos.durability.name))
        elif isinstance(qos, int):
            self.made.append(Made(frame.f_lineno, role, name, qos, "reliable", "volatile"))
        else:
            self.made.append(Made(frame.f_lineno, role, name))


def _node_class(recorder: _Recorder) -> type:
    class Node:
        def __init__(self, node_name: str, **_options: Any) -> None:
            self._node_name = node_name

        def create_publisher(self, _type: Any, topic: str, qos_profile: Any) -> object:
            recorder.make(sys._getframe(1), "publisher", topic, qos_profile)
            return object()

        def create_subscription(self, _type: Any, topic: str, _callback: Any, qos_profile: Any) -> object:
            recorder.make(sys._getframe(1), "subscription", topic, qos_profile)
            return object()

        def create_service(self, _type: Any, srv_name: str, _callback: Any) -> object:
            recorder.make(sys._getframe(1), "service_server", srv_name)
            return object()

        def declare_parameter(self, name: str, _value: Any = None) -> object:
            recorder.make(sys._getframe(1), "parameter", name)
            return object()

    return Node


def _modules(recorder: _Recorder) -> dict[str, ModuleType]:
    def module(name: str, **members: Any) -> ModuleType:
        made = ModuleType(name)
        for key, value in members.items():
            setattr(made, key, value)
        return made

    def nothing(*_arguments: Any, **_keywords: Any) -> None:
        return None

    policies = {
        "QoSReliabilityPolicy": _Policies("reliable", "best_effort"),
        "QoSDurabilityPolicy": _Policies("volatile", "transient_local"),
        "QoSHistoryPolicy": _Policies("keep_last", "keep_all"),
    }
    parts = [
        module("rclpy", init=nothing, spin=nothing, shutdown=nothing),
        module("rclpy.node", Node=_node_class(recorder)),
        module("rclpy.qos", QoSProfile=QoSProfile, **policies),
        module("std_msgs"),
        module("std_msgs.msg", String=type("String", (), {})),
        module("std_srvs"),
        module("std_srvs.srv", Empty=type("Empty", (), {})),
        module(
            "outside",
            ask=recorder.ask,
            number=recorder.number,
            text=recorder.text,
            risky=recorder.risky,
            context=recorder.context,
            left=recorder.leave,
        ),
    ]
    return {one.__name__: one for one in parts}


def _bounded() -> Callable[[FrameType, str, object], Any]:
    """Return a tracer that ends what goes on for ever: a list that a loop over it makes longer."""
    lines = 0

    def trace(_frame: FrameType, _event: str, _argument: object) -> Any:
        nonlocal lines
        lines += 1
        if lines > MOST_LINES:
            raise _Stop
        return trace

    return trace


def run(program: str, seed: int) -> Run:
    """Run a program and return what it made; what it raises ends it."""
    recorder = _Recorder(seed)
    stubs = _modules(recorder)
    before = {name: sys.modules.get(name) for name in stubs}
    sys.modules.update(stubs)
    error = ""
    traced = sys.gettrace()
    try:
        code = compile(program, "made_up.py", "exec")
        sys.settrace(_bounded())
        exec(code, {"__name__": "__main__"})
    except (Exception, _Stop) as problem:  # noqa: BLE001 - whatever a made-up program raises ends it
        error = f"{type(problem).__name__}: {problem}"
    finally:
        sys.settrace(traced)
        for name, module in before.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module
    return Run(tuple(recorder.made), error, recorder.left)
