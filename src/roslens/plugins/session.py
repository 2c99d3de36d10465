"""The plug-ins of one call, their workers, and what they reported so far."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import reduce
from pathlib import Path
from types import TracebackType
from typing import Any

from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.quantity import Measurement
from roslens.model.source import Location
from roslens.plugins.contract_failures import TOOL, failed_running
from roslens.plugins.frames import (
    LOADING,
    Engaged,
    FilesTask,
    Gave,
    LoadTask,
    PackageTask,
    ResultsTask,
    Step,
    Task,
    WorkspaceTask,
)
from roslens.plugins.job import Death, Job
from roslens.plugins.log import write_log
from roslens.plugins.member import Member
from roslens.plugins.options import resolve_options
from roslens.plugins.outcome import Outcome, settle
from roslens.plugins.points import HOOKS
from roslens.plugins.pool import HANGS_BEFORE_GIVING_UP, InlineWorkers, ProcessWorkers, Workers

Options = Mapping[str, Mapping[str, object]]
"""What the user set, by plug-in and option."""

Reported = Callable[[str], None]
"""Hears of each call of a hook that is over."""


class Session:
    """Sends tasks to workers and keeps what comes back, plug-in by plug-in."""

    def __init__(
        self,
        members: Sequence[Member],
        options: Options,
        time_limit_s: float,
        jobs: int,
        log: Path | None,
        progress: Reported | None,
        workers: Workers | None,
    ) -> None:
        """Take what :func:`roslens.plugins.isolation.run_package` takes; wrong options leave a plug-in out."""
        self._options: dict[str, dict[str, Any]] = {}
        self._failures: list[Failure] = []
        for member in members:
            try:
                self._options[member.name] = resolve_options(member.manifest, options.get(member.name, {}))
            except UsageError as error:
                self._failures.append(_wrong_option(member.name, error))
        self.members = tuple(member for member in members if member.name in self._options)
        self.measured: dict[str, dict[str, float]] = {}
        self._gave: dict[str, list[Gave]] = {member.name: [] for member in self.members}
        self._progress = progress
        self._log = log
        self._owned = ExitStack()
        self._workers = workers or self._own_workers(time_limit_s, jobs)

    def _own_workers(self, time_limit_s: float, jobs: int) -> Workers:
        if jobs == 0:
            return InlineWorkers()
        return self._owned.enter_context(ProcessWorkers(jobs, time_limit_s=time_limit_s, log=self._log))

    def __enter__(self) -> Session:
        """Return the session; workers start with the first task."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the workers that were started for this session alone."""
        self._owned.close()

    def engaged(self, member: Member) -> Engaged:
        """Return a member as a task names it."""
        return Engaged(member.name, member.spec, self._options[member.name])

    def fail(self, failure: Failure) -> None:
        """Keep a failure that belongs to no plug-in."""
        self._failures.append(failure)

    def know(self, measurements: Iterable[Measurement]) -> None:
        """Show plug-ins what was measured before this session."""
        for measurement in measurements:
            self.measured.setdefault(measurement.entity, {})[measurement.quantity] = measurement.value

    def perform(self, tasks: Iterable[Task]) -> None:
        """Carry tasks out and keep what they report."""
        jobs = [Job(task, plugins=_plugins_of(task), home=_home_of(task)) for task in tasks]
        if not jobs:
            return
        self._workers.run(jobs, self._reported)
        for job in jobs:
            self._keep(job)

    def outcome(self) -> Outcome:
        """Return everything reported so far."""
        settled = [
            settle(
                member.name,
                {rule.id: rule for rule in member.manifest.rules},
                [finding for gave in self._gave[member.name] for finding in gave.findings],
                [measurement for gave in self._gave[member.name] for measurement in gave.measurements],
                [failure for gave in self._gave[member.name] for failure in gave.failures],
            )
            for member in self.members
        ]
        return reduce(Outcome.__add__, settled, Outcome(failures=tuple(self._failures)))

    def _reported(self, step: Step) -> None:
        if self._progress is not None and step.name != LOADING:
            self._progress(f"{step.plugin}: {step.name}")

    def _keep(self, job: Job) -> None:
        gave = [answer for answer in job.answers if isinstance(answer, Gave)]
        for death in job.deaths:
            gave.extend(_given_by_death(job, death))
        gave.extend(Gave(Step(plugin, LOADING), failures=(_given_up(plugin, job),)) for plugin in sorted(job.given_up))
        for answer in gave:
            self._gave[answer.step.plugin].append(answer)
            self.know(answer.measurements)
            for failure in answer.failures:
                if failure.detail:
                    write_log(self._log, failure.tool, f"{failure}\n{failure.detail}")


def _plugins_of(task: Task) -> tuple[str, ...]:
    if isinstance(task, FilesTask):
        return tuple(engaged.name for engaged in task.plugins)
    return () if isinstance(task, LoadTask) else (task.plugin.name,)


def _home_of(task: Task) -> str:
    """A plug-in that works on the whole workspace keeps its process: it may hold in memory what it learned."""
    return task.plugin.name if isinstance(task, WorkspaceTask | ResultsTask) else ""


def _package_of(task: Task) -> str:
    if isinstance(task, FilesTask):
        return task.package
    return task.package.package.id if isinstance(task, PackageTask) else ""


def _given_by_death(job: Job, death: Death) -> Iterator[Gave]:
    """Return the failure of what a worker was at when it died.

    A worker that dies before it says what it is at is tried once more; then all plug-ins of the task failed.
    """
    if death.at is None:
        if death is job.deaths[-1]:
            for plugin in job.plugins:
                failure = failed_running(
                    plugin, "its task", death.why, package=_package_of(job.task), detail=death.output, advice=_ADVICE
                )
                yield Gave(Step(plugin, LOADING), failures=(failure,))
        return
    step, path = death.at.step, death.at.path
    failure = failed_running(
        step.plugin,
        HOOKS["file"] if isinstance(job.task, FilesTask) and path else step.name,
        death.why,
        location=Location(path) if path else None,
        entity=f"file:{path}" if path else "",
        package=death.at.package or _package_of(job.task),
        detail=death.output,
        advice=_ADVICE,
    )
    yield Gave(step, failures=(failure,))


_ADVICE = "What it printed last is in the log; other files and plug-ins are not affected"


def _given_up(plugin: str, job: Job) -> Failure:
    return Failure(
        tool=plugin,
        what=f"plug-in {plugin!r} is not called again: it hung {HANGS_BEFORE_GIVING_UP} times",
        expected="hooks that return within the time limit",
        advice="Raise `time_limit_s`, or disable the plug-in",
        package=_package_of(job.task),
    )


def _wrong_option(plugin: str, error: UsageError) -> Failure:
    return Failure(
        tool=TOOL,
        what=f"plug-in {plugin!r} is left out: {error.where}: {error.what}",
        expected=error.expected,
        advice=error.advice,
    )
