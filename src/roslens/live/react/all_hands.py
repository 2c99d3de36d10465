"""Hands actions to who carries them out: the monitor, a process with ROS, this host, or the agent of another one."""

from __future__ import annotations

import queue
import re
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from roslens.live.act.ros import ActionError
from roslens.live.react.actor import CarriedOut
from roslens.live.react.node_places import NodePlaces
from roslens.live.react.prepared import Prepared
from roslens.live.react.ros_line import RosLine
from roslens.live.react.rosout_beside import RosoutBeside
from roslens.model.acting.action_kind import ActionKind, By, action_kind
from roslens.model.acting.host_request import HostRequest
from roslens.model.acting.order import Reply, Verb
from roslens.model.acting.reaction import ActionCall, Decision, Reaction
from roslens.model.entity import EntityKind
from roslens.model.errors import RoslensError

_NAME = re.compile(r"[^A-Za-z0-9._-]+")


def name_of(decision: Decision) -> str:
    """Return a name for what is kept of a decision: when it was made, and its id."""
    stamp = time.strftime("%Y%m%dT%H%M%S", time.gmtime(decision.at_s))
    return f"{stamp}-{_NAME.sub('_', decision.id)[:80]}"


class HostHands(Protocol):
    """A host that can be asked, or the line to all others."""

    def begin(self, request: HostRequest) -> None:
        """Begin to carry a request out; returns at once."""


class FarHosts(Protocol):
    """Agents that take requests."""

    def ask(self, host: str, request: HostRequest) -> str:
        """Ask a host; return why that cannot be, empty where it is asked."""

    def poll(self) -> list[CarriedOut]:
        """Return what became of requests."""


class AllHands:
    """Who carries out what.

    Args:
        lines: processes that act in ROS, one of each generation that is observed.
        places: of nodes.
        host: name of this host.
        here: acts on this host; None where there is no allow-list for it.
        far: agents of other hosts.
        recordings: folder for what ``record`` writes.
        monitor: looks at what it needs for what needs neither ROS nor a host, and returns what carries it out.
        steady: a clock that never jumps.
    """

    def __init__(
        self, lines: Sequence[RosLine], places: NodePlaces, host: str, *, here: HostHands | None,
        far: FarHosts | None, recordings: Path, monitor: Callable[[Decision], Callable[[], str]],
        steady: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        self._lines = list(lines)
        self._places = places
        self._host = host
        self._here = here
        self._far = far
        self._recordings = recordings
        self._monitor = monitor
        self._steady = steady
        self._came: queue.SimpleQueue[CarriedOut] = queue.SimpleQueue()
        self._waited_for: dict[str, int] = {}
        self._best: dict[str, CarriedOut] = {}
        self._prepared = Prepared()
        self._next: Prepared | None = None
        self._turn = 0
        self._rosout = RosoutBeside(self._lines)
        self._snapshots: dict[str, Path] = {}

    def prepare(self, reactions: Sequence[Reaction]) -> None:
        """Get ready for every action of some reactions that needs ROS; :meth:`unready` returns the progress."""
        self._prepared.ask(self._lines, reactions)
        self._rosout.prepare(reactions)

    def unready(self) -> dict[str, str]:
        """Return what cannot be done in any ROS that is observed, and why, by its place in the document."""
        return self._prepared.unready()

    def waiting(self) -> bool:
        """Whether some executor has not reported yet whether all can be done."""
        return self._prepared.waiting()

    def prepare_next(self, reactions: Sequence[Reaction]) -> Prepared:
        """Get ready for other reactions beside those that hold, until :meth:`take_next` or :meth:`drop_next`."""
        self.drop_next()
        self._turn += 1
        self._next = Prepared(self._turn)
        self._next.ask(self._lines, reactions)
        self._rosout.prepare(reactions)
        return self._next

    def take_next(self) -> None:
        """Be ready for what :meth:`prepare_next` was given in place of what was before."""
        if self._next is not None:
            self._prepared.forget(self._lines)
            self._prepared, self._next = self._next, None

    def drop_next(self) -> None:
        """Go on as before."""
        if self._next is not None:
            self._next.forget(self._lines)
            self._next = None

    def reported(self, done: CarriedOut) -> None:
        """Take what became of something; for any thread."""
        self._came.put(done)

    def do(self, decision: Decision) -> None:
        """Begin to carry a decision out."""
        kind = action_kind(decision.action.kind)
        if kind is None:
            self._fail(decision, f"{decision.action.kind!r} is not an action")
        elif kind.by is By.ROS:
            self._through_ros(decision, kind)
        elif kind.by is By.HOST:
            self._on_host(decision)
        else:
            try:
                work = self._monitor(decision)
            except RoslensError as error:
                self._fail(decision, str(error))
                return
            if kind.key == "snapshot":
                self._snapshots[decision.id] = self._recordings.parent / "snapshots" / name_of(decision)
            threading.Thread(target=self._here_and_now, args=(decision, work), name=decision.id, daemon=True).start()

    def descriptors(self) -> list[int]:
        """Return what becomes readable when something was carried out through ROS."""
        return [file for line in self._lines if (file := line.fileno()) is not None]

    def poll(self) -> list[CarriedOut]:
        """Return what was carried out since the last time."""
        found = self._done_here()
        for line in self._lines:
            for reply in line.poll():
                found += self._replied(line.generation, reply)
        if self._far is not None:
            found += self._far.poll()
        return found

    def _done_here(self) -> list[CarriedOut]:
        """Return what threads of this process carried out; a snapshot comes when all of it is there."""
        found: list[CarriedOut] = []
        while True:
            try:
                came = self._came.get_nowait()
            except queue.Empty:
                return found
            folder = self._snapshots.pop(came.decision, None)
            if folder is None or not self._rosout.add(came, folder):
                found.append(came)

    def _replied(self, generation: int, reply: Reply) -> list[CarriedOut]:
        """Take a reply of a line; return what was carried out by that."""
        if reply.verb is Verb.PREPARE:
            for prepared in filter(None, (self._prepared, self._next)):
                prepared.take(generation, reply)
            return []
        of_rosout, snapshot = self._rosout.take(reply)
        found = [snapshot] if snapshot is not None else []
        if not of_rosout and reply.id != "journal":
            found += self._of_line(CarriedOut(reply.id, reply.done, reply.text, reply.duration_s))
        return found

    def clear(self, decision: str) -> None:
        """End what repeats for a decision."""
        for line in self._lines:
            line.clear(decision)

    def stop(self) -> None:
        """End everything that repeats."""
        for line in self._lines:
            line.stop()

    def say(self, topic: str, text: str) -> None:
        """Publish a text in every ROS that is observed; whether it arrives is not looked at."""
        reported = {"topic": topic, "type": "std_msgs/String", "fields": {"data": text}, "how": "latched"}
        for line in self._lines:
            line.do("journal", "publish", "", reported)

    def close(self) -> None:
        """End the processes that act in ROS."""
        for line in self._lines:
            line.close()

    def _through_ros(self, decision: Decision, kind: ActionKind) -> None:
        call = decision.action
        lines = [one for one in self._lines if one.generation in kind.ros and self._fit(one, decision)]
        if not lines:
            self._fail(decision, "no ROS is observed in which it can be done")
            return
        if len(lines) > 1 and kind.targets and decision.action.target is not None:
            name = decision.action.target.name
            generations = self._places.generations_of(name)
            if len(generations) != 1:
                known = "a node of that name is in both" if generations else "no node of that name was observed"
                self._fail(
                    decision,
                    f"ROS 1 and ROS 2 are both observed, and it is unknown which one {name} belongs to: {known}",
                )
                return
            lines = [one for one in lines if one.generation in generations]
        self._waited_for[decision.id] = len(lines)
        target = call.target.name if call.target is not None else ""
        for line in lines:
            reported = kind.filled(call.arguments)
            if call.kind == "record":
                reported["path"] = str(self._recordings / f"{name_of(decision)}-ros{line.generation}.mcap")
            try:
                line.do(decision.id, call.kind, target, reported)
            except ValueError as error:
                self.reported(CarriedOut(decision.id, False, str(error)))

    def _fit(self, line: RosLine, decision: Decision) -> bool:
        return self._prepared.fit(line.generation, decision)

    def _of_line(self, done: CarriedOut) -> list[CarriedOut]:
        """Return what became of something once all have reported that were asked, the best of it."""
        left = self._waited_for.get(done.decision, 1) - 1
        best = self._best.get(done.decision)
        if best is None or done.done:
            best = done
        if left > 0:
            self._waited_for[done.decision], self._best[done.decision] = left, best
            return []
        self._waited_for.pop(done.decision, None)
        self._best.pop(done.decision, None)
        return [best]

    def _on_host(self, decision: Decision) -> None:
        try:
            host, request = self._request(decision)
        except ActionError as error:
            self._fail(decision, str(error))
            return
        if host == self._host:
            if self._here is None:
                why = f"{host} is this host, and has no allow-list here: give one with --allow FILE"
                self._came.put(CarriedOut(decision.id, False, why, refused=True))
            else:
                self._here.begin(request)
        elif self._far is None:
            self._fail(decision, f"{request.node or host} is on {host}, whose agent takes no requests: see --enrolled")
        elif why := self._far.ask(host, request):
            self._fail(decision, why)

    def _request(self, decision: Decision) -> tuple[str, HostRequest]:
        call: ActionCall = decision.action
        kind = action_kind(call.kind)
        arguments = kind.filled(call.arguments) if kind is not None else dict(call.arguments)
        target = call.target
        if target is None:
            raise ActionError(f"`{call.kind}` without a target")
        if target.kind is EntityKind.HOST:
            return target.name, HostRequest(decision.id, call.kind, "", 0, (), arguments)
        home = self._places.of(target.name)
        if home is None:
            raise ActionError(
                f"the host of {target.name} is unknown",
                expected="a node that was observed long enough for its process to be known (some seconds)",
            )
        return home.host, HostRequest(decision.id, call.kind, target.name, home.pid, home.beside, arguments)

    def _here_and_now(self, decision: Decision, work: Callable[[], str]) -> None:
        began = self._steady()
        try:
            text, done = work(), True
        except RoslensError as error:
            text, done = str(error), False
        except Exception as error:  # noqa: BLE001 - an action that fails ends nothing else
            text, done = f"{type(error).__name__}: {error}", False
        self._came.put(CarriedOut(decision.id, done, text, self._steady() - began))

    def _fail(self, decision: Decision, text: str) -> None:
        self._came.put(CarriedOut(decision.id, False, text))
