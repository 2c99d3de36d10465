"""Worker processes that are killed when they hang and replaced when they die."""

from __future__ import annotations

import os
import selectors
import time
from collections import Counter, deque
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import Protocol

import msgspec

from roslens.children.sandbox import Sandbox
from roslens.children.scratch_folder import ScratchFolder
from roslens.plugins.frames import LOADING, Answer, Began, Ended, Gave, Order, Step, TooMuchError
from roslens.plugins.job import Death, Job
from roslens.plugins.log import write_log
from roslens.plugins.process import WorkerProcess

HANGS_BEFORE_GIVING_UP = 3
"""A plug-in that hung this often is not called again: each hang costs the whole time limit."""

_START_LIMIT_S = 30.0
"""Seconds until a worker says what it is at; no plug-in runs before."""

_PIECE = 1 << 16
_OUTPUT_SHOWN = 4000


def _unheard(_step: Step) -> None:
    """Nobody listens."""


class Workers(Protocol):
    """Whatever carries out jobs."""

    def run(self, jobs: Sequence[Job], reported: Callable[[Step], None] = ...) -> None:
        """Carry out the jobs; ``reported`` hears of each step that is over."""


class ProcessWorkers:
    """Up to ``jobs`` worker processes, started when needed and kept until the end of the ``with`` block."""

    def __init__(
        self,
        jobs: int = 1,
        *,
        time_limit_s: float = 60.0,
        load_limit_s: float = 20.0,
        log: Path | None = None,
        hash_seed: str = "0",
        sandbox: Sandbox | None = None,
    ) -> None:
        """Choose how many, how long a step may take, and where output goes.

        Args:
            jobs: worker processes at most; at least one.
            time_limit_s: seconds that one step may take.
            load_limit_s: seconds that the import of a plug-in may take.
            log: receives what plug-ins print; None drops it, but for the last lines before a crash.
            hash_seed: ``PYTHONHASHSEED`` of the workers, so that sets have the same order in each run.
            sandbox: what plug-ins may touch besides :meth:`scratch`; None for all that the user may.
        """
        self._wanted = max(1, jobs)
        self._limit_s = time_limit_s
        self._load_limit_s = load_limit_s
        self._log = log
        self._hash_seed = hash_seed
        self._sandbox = sandbox
        self._workers: list[WorkerProcess] = []
        self._hangs: Counter[str] = Counter()
        self._folder: ScratchFolder | None = None
        self.started = 0

    def __enter__(self) -> ProcessWorkers:
        """Start nothing yet."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Kill the workers with everything they started."""
        for worker in self._workers:
            self._keep_output(worker, "")
            worker.kill()
        self._workers.clear()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def run(self, jobs: Sequence[Job], reported: Callable[[Step], None] = _unheard) -> None:
        """Carry out the jobs; ``reported`` hears of each step that is over."""
        waiting = deque(jobs)
        with selectors.DefaultSelector() as selector:
            try:
                while waiting or any(worker.job for worker in self._workers):
                    self._assign(waiting, selector)
                    ready = selector.select(self._patience())
                    for key, _ in ready:
                        self._hear(key.data, waiting, selector, reported)
                    self._end_hangs(waiting, selector)
            except BaseException:
                for worker in self._workers:
                    worker.kill()
                self._workers.clear()
                raise

    def _assign(self, waiting: deque[Job], selector: selectors.BaseSelector) -> None:
        for _ in range(len(waiting)):
            job = waiting.popleft()
            for plugin in job.plugins:
                if self._hangs[plugin] >= HANGS_BEFORE_GIVING_UP:
                    job.give_up(plugin)
            worker = self._worker_for(job)
            if worker is None:
                waiting.append(job)
                continue
            if job.home:
                worker.homes.add(job.home)
            worker.start(job, time.monotonic() + _START_LIMIT_S)
            selector.register(worker.stdout, selectors.EVENT_READ, worker)

    def _worker_for(self, job: Job) -> WorkerProcess | None:
        if job.home:
            for worker in self._workers:
                if job.home in worker.homes:
                    return None if worker.job else worker
        for worker in self._workers:
            if worker.job is None:
                return worker
        if len(self._workers) >= self._wanted:
            return None
        self.started += 1
        folder, sandbox = self._own_folder(), self._sandbox
        if sandbox is not None:
            sandbox = msgspec.structs.replace(sandbox, write=(self.scratch(), *sandbox.write))
        worker = WorkerProcess(folder / f"output-{self.started}", self._hash_seed, sandbox)
        self._workers.append(worker)
        return worker

    def scratch(self) -> str:
        """Return the folder that all workers may write, which is removed with them; it is the home of plug-ins."""
        place = self._own_folder() / "scratch"
        place.mkdir(exist_ok=True)
        return str(place)

    def _own_folder(self) -> Path:
        if self._folder is None:
            self._folder = ScratchFolder("plugins")
        return Path(self._folder.name)

    def _patience(self) -> float:
        deadlines = [worker.deadline for worker in self._workers if worker.job]
        return max(0.0, min(deadlines) - time.monotonic())

    def _hear(
        self,
        worker: WorkerProcess,
        waiting: deque[Job],
        selector: selectors.BaseSelector,
        reported: Callable[[Step], None],
    ) -> None:
        try:
            piece = os.read(worker.stdout, _PIECE)
            answers = worker.buffer.feed(piece)
        except TooMuchError as error:
            self._bury(worker, str(error), waiting, selector)
            return
        except (OSError, msgspec.DecodeError):
            piece, answers = b"", []
        if not piece:
            self._bury(worker, worker.ended(), waiting, selector)
            return
        for answer in answers:
            if worker.job is None:
                # A second end of the same task is none that was asked for.
                break
            if isinstance(answer, Began):
                worker.at = answer
                worker.deadline = time.monotonic() + self._limit_of(answer.step)
            elif isinstance(answer, Ended):
                worker.job = None
                selector.unregister(worker.stdout)
            else:
                worker.job.receive(answer)
                if isinstance(answer, Gave) and answer.over:
                    self._keep_output(worker, f"{answer.step.plugin}: {answer.step.name}", answer.printed)
                    reported(answer.step)

    def _end_hangs(self, waiting: deque[Job], selector: selectors.BaseSelector) -> None:
        now = time.monotonic()
        for worker in [worker for worker in self._workers if worker.job and worker.deadline <= now]:
            if worker.at is not None:
                self._hangs[worker.at.step.plugin] += 1
            limit_s = self._limit_of(worker.at.step) if worker.at else _START_LIMIT_S
            self._bury(worker, f"it took longer than {limit_s:g} s", waiting, selector)

    def _limit_of(self, step: Step) -> float:
        return self._load_limit_s if step.name == LOADING else self._limit_s

    def _bury(self, worker: WorkerProcess, why: str, waiting: deque[Job], selector: selectors.BaseSelector) -> None:
        job = worker.job
        selector.unregister(worker.stdout)
        at = worker.at
        worker.kill()
        output = self._keep_output(worker, f"{at.step.plugin}: {at.step.name}" if at else "starting")
        self._workers.remove(worker)
        if job is None:
            return
        job.died(Death(at, why, output))
        if at is not None or len(job.deaths) == 1:
            waiting.appendleft(job)

    def _keep_output(self, worker: WorkerProcess, title: str, until: int = -1) -> str:
        """Move what a worker printed, up to a byte where one is known, to the log; return the end of it."""
        text = worker.new_output(until)
        if text:
            write_log(self._log, title or "between hooks", text)
        return text[-_OUTPUT_SHOWN:]


class InlineWorkers:
    """No process at all: hooks run here, without a time limit. For a debugger."""

    def run(self, jobs: Sequence[Job], reported: Callable[[Step], None] = _unheard) -> None:
        """Carry out the jobs; ``reported`` hears of each step that is over."""
        from roslens.plugins.perform import Performer

        for job in jobs:

            def keep(answer: Answer, job: Job = job) -> None:
                job.receive(answer)
                if isinstance(answer, Gave) and answer.over:
                    reported(answer.step)

            Performer(keep).perform(Order(job.task))
