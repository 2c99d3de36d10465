"""Whether a decision may be carried out: off unless enabled, and not too often.

Pure: clocks are arguments. In this order: a hold, the mode, a maintenance window, what was given up, the cool-down
of the same action on the same entity, what another reaction does to the same process, the limit for all. What
touches the robot and what only tells (``ActionKind.touches``) have a limit each, so that notices never keep an
emergency stop from being done.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from enum import Enum

import msgspec

from roslens.live.react.maintenance import Window, window_now
from roslens.live.react.node_places import Home
from roslens.model.acting.action_kind import action_kind
from roslens.model.acting.reaction import Decision, Mode
from roslens.model.entity import EntityKind

_CAREFUL = (Mode.DRY_RUN, Mode.ASK, Mode.ACT)
"""From the most careful mode on."""

_RESTARTS = frozenset({"restart", "start"})
_PROCESS = frozenset({"restart", "start", "stop", "kill"})
"""What ends or begins a process: a node that restarts is gone for a moment, which no other reaction should repair."""
_MOST_KEYS = 10_000
_LOOK_AGAIN_S = 0.5


class Answer(str, Enum):
    """The answer of a gate to a decision."""

    ALLOW = "allow"
    ASK = "ask"
    WAIT = "wait"
    DRY_RUN = "dry-run"
    REFUSE = "refuse"
    HELD = "held"
    GIVE_UP = "give up"


class GateAnswer(msgspec.Struct, frozen=True):
    """The answer of a gate and its reason, in words; for ``WAIT`` the seconds until the next attempt."""

    answer: Answer
    text: str
    again_s: float = 0.0


class Limits(msgspec.Struct, frozen=True):
    """How careful a gate is.

    Attributes:
        mode: what decisions lead to at most; None: reactions are off.
        cool_down_s: between the same action on the same entity.
        at_most: actions that touch the robot in ``per_s``, of all together; and as many that only tell.
        per_s: seconds that ``at_most`` is about.
        most_restarts: of one entity within ``restarts_per_s``, after which it is given up until somebody releases it.
        restarts_per_s: seconds that ``most_restarts`` is about.
        windows: in which nothing that touches the robot is done.
    """

    mode: Mode | None = None
    cool_down_s: float = 10.0
    at_most: int = 10
    per_s: float = 60.0
    most_restarts: int = 3
    restarts_per_s: float = 600.0
    windows: tuple[Window, ...] = ()


class _Process(msgspec.Struct, frozen=True):
    """Who ends or begins a process for which node, and when that was done; None while it is under way."""

    decision: str
    reaction: str
    target: str
    kind: str
    ended: float | None = None


class Gate:
    """Decides whether each decision is carried out, and remembers those that were.

    Times are seconds on a clock that never jumps, but for ``wall_s``, which is that of the host.

    Args:
        limits: how careful it is.
        home: the process of a node, or its last one, and the nodes that share it; None where that is unknown. Nodes of
            one process are ended and begun as one, once, whichever of them is asked for.
    """

    def __init__(self, limits: Limits, home: Callable[[str], Home | None] = lambda _: None) -> None:
        """Begin with nothing done."""
        self._limits = limits
        self._home = home
        self._last: dict[tuple[str, str], float] = {}
        self._done: dict[bool, deque[float]] = {True: deque(), False: deque()}
        self._restarts: dict[str, deque[float]] = {}
        self._processes: dict[str, _Process] = {}
        self._given_up: dict[str, str] = {}

    @property
    def given_up(self) -> tuple[str, ...]:
        """Entities that are restarted no more, sorted."""
        return tuple(sorted(self._given_up))

    def judge(self, decision: Decision, now_s: float, *, wall_s: float, held: str = "") -> GateAnswer:
        """Return the answer to a decision; ``held`` is who put everything on hold and why, empty if none did."""
        if held:
            return GateAnswer(Answer.HELD, f"everything is held: {held}")
        if self._limits.mode is None:
            return GateAnswer(Answer.REFUSE, "reactions are off: enable them with --mode")
        touches = _touches(decision)
        if touches and (window := window_now(self._limits.windows, wall_s)):
            return GateAnswer(Answer.REFUSE, f"maintenance: {window.text}")
        target = target_of(decision)
        kind = decision.action.kind
        if kind in _RESTARTS and (why := self._given_up.get(target)):
            return GateAnswer(Answer.GIVE_UP, why)
        cool = self._limits.cool_down_s - (now_s - self._last.get((kind, target), float("-inf")))
        if cool > 0:
            usual = f"{self._limits.cool_down_s:g} s"
            text = f"cool-down: {kind} {target} was done less than {usual} ago, {cool:.1f} s are left"
            return GateAnswer(Answer.WAIT, text, cool)
        if (another := self._done_by_another(decision, target, now_s)) is not None:
            return another
        if kind in _RESTARTS and (why := self._too_many_restarts(target, now_s)):
            self._given_up[target] = why
            return GateAnswer(Answer.GIVE_UP, why)
        done = self._done[touches]
        if self._count(done, now_s, self._limits.per_s) >= self._limits.at_most:
            what = "actions" if touches else "notices"
            text = f"limit for all: {self._limits.at_most} {what} in {self._limits.per_s:g} s were done already"
            return GateAnswer(Answer.WAIT, text, self._limits.per_s - (now_s - done[0]) if done else self._limits.per_s)
        return self._by_mode(decision, touches=touches)

    def done(self, decision: Decision, now_s: float) -> None:
        """Remember that an action is begun, or would have been in a dry run."""
        kind, target = decision.action.kind, target_of(decision)
        if len(self._last) >= _MOST_KEYS:
            self._last.pop(next(iter(self._last)))
        self._last[(kind, target)] = now_s
        self._done[_touches(decision)].append(now_s)
        if kind in _PROCESS:
            if len(self._processes) >= _MOST_KEYS:
                self._processes.pop(next(iter(self._processes)))
            self._processes[self._process_of(decision)] = _Process(decision.id, decision.reaction, target, kind)
        if kind in _RESTARTS:
            for one in self._ended_with(decision, target):
                self._restarts.setdefault(one, deque(maxlen=self._limits.most_restarts + 1)).append(now_s)

    def ended(self, decision: Decision, now_s: float) -> None:
        """Remember that an action is no more under way."""
        for process, held in self._processes.items():
            if held.decision == decision.id:
                self._processes[process] = msgspec.structs.replace(held, ended=now_s)
                return

    def release(self) -> tuple[str, ...]:
        """Forget what was given up and how often it was restarted; return what was."""
        freed = self.given_up
        self._given_up.clear()
        self._restarts.clear()
        return freed

    def _done_by_another(self, decision: Decision, target: str, now_s: float) -> GateAnswer | None:
        """Return ``WAIT`` if another chain of actions has just ended or started the same process."""
        if decision.action.kind not in _PROCESS:
            return None
        process = self._process_of(decision)
        held = self._processes.get(process)
        if held is None or (held.reaction, held.target) == (decision.reaction, target):
            return None
        shared = "" if held.target == target else f", whose process {process} holds {target} too,"
        if held.ended is None:
            text = f"`{held.kind}` of {held.target}{shared} is under way for {held.reaction}"
            return GateAnswer(Answer.WAIT, text, _LOOK_AGAIN_S)
        left = self._limits.cool_down_s - (now_s - held.ended)
        if left <= 0:
            return None
        ago = f"{now_s - held.ended:.1f} s ago"
        text = (
            f"`{held.kind}` of {held.target}{shared} was done for {held.reaction} {ago}, which has to have its effect "
            f"first"
        )
        return GateAnswer(Answer.WAIT, text, left)

    def _home_of(self, decision: Decision) -> Home | None:
        target = decision.action.target
        found = self._home(target.name) if target is not None and target.kind is EntityKind.NODE else None
        return found if found is not None and found.pid else None

    def _process_of(self, decision: Decision) -> str:
        """Return the process that is ended or begun, as ``host/pid``; of an unknown one the target."""
        home = self._home_of(decision)
        return f"{home.host}/{home.pid}" if home is not None else target_of(decision)

    def _ended_with(self, decision: Decision, target: str) -> tuple[str, ...]:
        """Return everything that is restarted where the target is."""
        home = self._home_of(decision)
        beside = home.beside if home is not None else ()
        return (target, *(f"{EntityKind.NODE.value}:{node}" for node in beside))

    def _too_many_restarts(self, target: str, now_s: float) -> str:
        found = self._restarts.get(target)
        if found is None or self._count(found, now_s, self._limits.restarts_per_s) < self._limits.most_restarts:
            return ""
        return (
            f"{target} was restarted {self._limits.most_restarts} times in {self._limits.restarts_per_s:g} s and is "
            f"given up: look at it, then `roslens react --release`"
        )

    def _by_mode(self, decision: Decision, *, touches: bool) -> GateAnswer:
        asked = [mode for mode in (self._limits.mode, decision.mode) if mode is not None]
        mode = min(asked, key=_CAREFUL.index)
        if mode is Mode.DRY_RUN:
            return GateAnswer(Answer.DRY_RUN, "dry run: nothing is done")
        if mode is Mode.ASK and touches:
            return GateAnswer(Answer.ASK, "it needs approval")
        return GateAnswer(Answer.ALLOW, f"mode {mode.value}")

    @staticmethod
    def _count(times: deque[float], now_s: float, within_s: float) -> int:
        while times and now_s - times[0] >= within_s:
            times.popleft()
        return len(times)


def target_of(decision: Decision) -> str:
    """Return the text form of what an action is done to: its target, or what it names in place of one."""
    action = decision.action
    if action.target is not None:
        return str(action.target)
    for name in ("topic", "service", "container", "url"):
        if isinstance(found := action.arguments.get(name), str):
            return found
    return decision.entity


def recalled(gate: Gate, done: Iterable[tuple[Decision, float]], now_s: float) -> None:
    """Let a gate remember what was done before this process began: decisions and how many seconds ago."""
    for decision, ago_s in sorted(done, key=lambda one: -one[1]):
        gate.done(decision, now_s - max(ago_s, 0.0))
        gate.ended(decision, now_s - max(ago_s, 0.0))


def _touches(decision: Decision) -> bool:
    kind = action_kind(decision.action.kind)
    return kind is None or kind.touches
