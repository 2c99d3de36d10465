"""Acts on the processes of this host, as far as its allow-list permits; each action in a thread of its own."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import cast

import msgspec

from roslens.children.detached import run_words, start_detached
from roslens.live.act.host import Carrying, Known
from roslens.live.act.ros import ActionError
from roslens.live.agent.allow_list import AllowList
from roslens.live.agent.process_record import ProcessRecords, Recorded
from roslens.model.acting.action_kind import By, action_kind
from roslens.model.acting.host_request import HostRequest

_AT_ONCE = 8
_LOOK_S = 0.1
_LONGEST_S = 120.0


class Done(msgspec.Struct, frozen=True):
    """What became of a request.

    Attributes:
        id: of the request.
        done: whether it was carried out.
        refused: whether the host said no before anything was tried.
        text: what was done, or why not.
        duration_s: how long it took.
    """

    id: str
    done: bool
    refused: bool = False
    text: str = ""
    duration_s: float = 0.0


class HostHand:
    """Carries requests out.

    Args:
        allow: what may be done.
        records: how the processes of nodes were started.
        reported: called with what became of each request, in any thread.
        announce: called with each request before it is carried out; what it raises keeps it from being done.
        output: folder for what restarted nodes print; None for nowhere.
        held: why nothing may be done now; empty where it may.
        steady: a clock that never jumps.
    """

    def __init__(
        self, allow: AllowList, records: ProcessRecords, reported: Callable[[Done], None], *,
        announce: Callable[[HostRequest], None] = lambda _: None, output: Path | None = None,
        held: Callable[[], str] = str, steady: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        self._allow = allow
        self._records = records
        self._reported = reported
        self._announce = announce
        self._output = output
        self._held = held
        self._steady = steady
        self._lock = threading.Lock()
        self._busy: dict[tuple[str, int], str] = {}
        self._started: list[subprocess.Popen[bytes]] = []

    def refusal(self, request: HostRequest) -> str:
        """Return why a request is refused, empty where it may be carried out."""
        if why := self._held():
            return f"everything is held: {why}"
        kind = action_kind(request.kind)
        if kind is None or kind.by is not By.HOST:
            return f"{request.kind[:60]!r} is nothing that a host does"
        known = self._records.of(request.pid)
        if known is None:
            return self._allow.refusal(request, "")
        # What a monitor says of a process is no reason to end it.
        shown = not self.alive(known) or self._records.shows(known, request.node)
        return self._allow.refusal(request, known.command, shown=shown)

    def begin(self, request: HostRequest) -> None:
        """Start to carry out a request, or report why not; returns at once."""
        self._reap()
        why = self.refusal(request)
        # One action at a time on each process, however many nodes it holds: two would each start it again.
        key = ("", request.pid) if request.kind == "command" or request.pid else (request.node, 0)
        with self._lock:
            if not why and key in self._busy:
                what = f"process {request.pid}" if request.pid else "it"
                why = f"{self._busy[key]}, which was begun before on {what}, is still under way"
            if not why and len(self._busy) >= _AT_ONCE:
                why = f"{_AT_ONCE} actions are under way already"
            if not why:
                self._busy[key] = f"`{request.kind}` of {request.node}" if request.node else f"`{request.kind}`"
        if why:
            self._reported(Done(request.id, False, True, why))
            return
        threading.Thread(target=self._carry_out, args=(request, key), name=f"does {request.id}", daemon=True).start()

    def process(self, request: HostRequest) -> Recorded:
        """Return the process that a request is about.

        Raises:
            ActionError: nobody recorded it.
        """
        found = self._records.of(request.pid) if request.pid else None
        if found is None:
            raise ActionError(
                f"process {request.pid or 'unknown'} of {request.node} was not recorded",
                expected="a process that held nodes while this host was watched",
            )
        return found

    def alive(self, process: Known) -> bool:
        """Whether that very process is there."""
        return self._records.alive(cast("Recorded", process))

    def signal(self, process: Known, number: int) -> None:
        """Send a signal to that very process, and to none that has its number later.

        Raises:
            ActionError: it is another user's.
        """
        try:
            handle = os.pidfd_open(process.pid)
        except ProcessLookupError:
            return
        try:
            if self.alive(process):
                signal.pidfd_send_signal(handle, number)
        except ProcessLookupError:
            return
        except PermissionError:
            raise ActionError(f"process {process.pid} is another user's", expected="one of this user") from None
        finally:
            os.close(handle)

    def ends(self, process: Known, within_s: float) -> bool:
        """Wait until it has ended; return whether it has."""
        try:
            handle = os.pidfd_open(process.pid)
        except ProcessLookupError:
            return True
        try:
            if self.alive(process):
                select.select([handle], [], [], within_s)
        finally:
            os.close(handle)
        self._reap()
        return not self.alive(process)

    def comes_back(self, process: Known, within_s: float) -> int:
        """Wait until the same command has been started again; return the id of the process, 0 for none."""
        end = self._steady() + within_s
        while True:
            if pid := self._records.again(cast("Recorded", process)):
                return pid
            if self._steady() >= end:
                return 0
            time.sleep(_LOOK_S)

    def start(self, process: Known, node: str) -> int:
        """Start a process as it was started before.

        Raises:
            ActionError: a hold came in between, or it cannot be started.
        """
        if why := self._held():
            raise ActionError(f"not started: everything is held: {why}")
        known = cast("Recorded", process)
        output = None
        if self._output is not None:
            self._output.mkdir(parents=True, exist_ok=True, mode=0o700)
            output = self._output / f"{node.strip('/').replace('/', '.') or 'node'}.log"
        own = known.user == (os.getuid(), os.getgid(), tuple(os.getgroups())) or os.geteuid() != 0
        try:
            started = start_detached(
                known.words, program=known.program, environment=known.environment, folder=known.folder, output=output,
                user=None if own else known.user,
            )  # fmt: skip
        except OSError as error:
            raise ActionError(f"{known.command[:200]!r} cannot be started: {error.strerror or error}") from None
        with self._lock:
            self._started.append(started)
        # A program that is wrong ends at once.
        try:
            code = started.wait(_LOOK_S)
        except subprocess.TimeoutExpired:
            return started.pid
        raise ActionError(f"{known.command[:200]!r} ended at once with {code}")

    def run(self, name: str) -> str:
        """Run a command of the allow-list.

        Raises:
            ActionError: it is not on it, failed, or did not end in time.
        """
        command = self._allow.commands.get(name)
        if command is None:
            raise ActionError(f"the command {name[:60]!r} is not on the allow-list")
        try:
            code, output = run_words(command.words, min(command.timeout_s, _LONGEST_S))
        except OSError as error:
            raise ActionError(f"{command.words[0]} cannot be started: {error.strerror or error}") from None
        except subprocess.TimeoutExpired:
            raise ActionError(f"{name} did not end within {command.timeout_s:g} s and was killed") from None
        last = output.rpartition("\n")[2][:200]
        if code:
            raise ActionError(f"{name} ended with {code}{f': {last}' if last else ''}", expected="exit code 0")
        return f"{name} ended with 0{f': {last}' if last else ''}"

    def _carry_out(self, request: HostRequest, key: tuple[str, int]) -> None:
        began = self._steady()
        done, refused = False, False
        try:
            try:
                self._announce(request)
            except Exception as error:  # noqa: BLE001 - what cannot be announced is not done
                refused = True
                raise ActionError(f"it could not be announced: {error}") from None
            module = cast("Carrying", import_module(f"roslens.live.act.actions.{request.kind}"))
            text, done = module.act(self, request), True
        except ActionError as error:
            text = str(error)
        except Exception as error:  # noqa: BLE001 - an action that fails ends nothing else
            text = f"{type(error).__name__}: {error}"
        finally:
            with self._lock:
                self._busy.pop(key, None)
        self._reported(Done(request.id, done, refused, text, self._steady() - began))

    def _reap(self) -> None:
        with self._lock:
            self._started = [one for one in self._started if one.poll() is None]
