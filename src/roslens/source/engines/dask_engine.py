"""Work on a cluster of Dask that exists already: its workers see the same files and run the same roslens.

What the cluster cannot finish is finished here: when its workers are gone, or its scheduler is, the tasks that are left
go to an engine of this machine, and nothing of what was done is done again. So does a task that workers died on.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import os
import socket
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import msgspec

from roslens.model.errors import UsageError
from roslens.source.engines.task_batch import batch_size, run_batch
from roslens.source.engines.task_limits import TaskLimits
from roslens.source.keys import analyser_version

if TYPE_CHECKING:
    from roslens.source.engines.task_engine import Executor

Task = TypeVar("Task")
Result = TypeVar("Result")

_AHEAD = 2
"""Batches that wait for each thread of the cluster."""

_CANCELLED = (asyncio.CancelledError, concurrent.futures.CancelledError)

_LOOK_S = 2.0
"""How often it is looked whether the cluster is still there."""

_TRIES = 3
"""Times that workers are asked whether they are fit, where one is lost meanwhile."""

_REACH_S = 2.0
"""Within which a worker is connected to, or results come by the scheduler."""


class DaskEngine:
    """Runs tasks on the workers of a scheduler."""

    def __init__(
        self,
        address: str,
        *,
        folder: str = "",
        rest: Executor,
        limits: TaskLimits | None = None,
        patience_s: float = 60.0,
        connect_s: float = 10.0,
        clock: Callable[[], float] = time.monotonic,
        connection: Callable[[], Any] | None = None,
    ) -> None:
        """Connect to nothing yet.

        Args:
            address: of the scheduler.
            folder: that workers have to see; empty for none.
            rest: runs here what the cluster does not finish.
            limits: of one task.
            patience_s: seconds that a cluster may be without workers, or out of reach.
            connect_s: seconds within which the scheduler has to answer first.
            clock: tells seconds.
            connection: returns one that :func:`fit_client` made; None has it made when there is work.
        """
        self._rest = rest
        self._folder = folder
        self._limits = limits or TaskLimits()
        self._patience_s = patience_s
        self._clock = clock
        self._connection = connection or (lambda: fit_client(address, folder, connect_s=connect_s))
        self._blamed: list[Any] = []
        self.done_here = 0

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Yield each task with its result, or with the exception that ended it.

        Raises:
            UsageError: the cluster cannot be reached, or its workers are not fit for the work.
        """
        if not tasks:
            return
        client = self._connection()
        left = list(reversed(tasks))
        under_way: dict[Any, list[Task]] = {}
        try:
            # Results that the scheduler hands on cost it more than all else that it does.
            client.direct_to_workers = _reaches_workers(client)
            yield from self._on_cluster(client, function, left, under_way)
        finally:
            # A scheduler that is gone is not waited for.
            with suppress(Exception):
                client.cancel(list(under_way), force=True)
            with suppress(Exception):
                client.close(timeout=5)
        remaining = [*(task for batch in under_way.values() for task in batch), *reversed(left), *self._blamed]
        self.done_here = len(remaining)
        yield from self._rest.run(function, remaining)

    def _on_cluster(
        self,
        client: Any,
        function: Callable[[Task], Result],
        left: list[Task],
        under_way: dict[Any, list[Task]],
    ) -> Iterator[tuple[Task, Result | BaseException]]:
        """Run until nothing is left, or the cluster is: what it did not finish stays in ``left`` and ``under_way``."""
        wait = _library().wait
        standing = _Standing(client, self._clock)
        batches = _Batches(left, under_way)

        def submit(batch: list[Task]) -> Any:
            limits = msgspec.structs.replace(self._limits, jobs=standing.on_one_host)
            return client.submit(run_batch, function, limits, self._folder, batch, pure=False)

        while left or under_way:
            if not batches.fill(submit, standing.threads):
                return
            # Cancelled ones, as those of a scheduler that is gone, are recognised by their status.
            with suppress(TimeoutError, OSError, *_CANCELLED), client.as_current():
                wait(list(under_way), timeout=_LOOK_S, return_when="FIRST_COMPLETED")
            finished = [future for future in under_way if future.status != "pending"]
            for future in finished:
                yield from self._came(future, batches)
            standing.look(at_once=any(future.status in ("cancelled", "lost") for future in finished))
            if standing.absent_s > self._patience_s:
                return

    def _came(self, future: Any, batches: _Batches[Task]) -> Iterator[tuple[Task, Any]]:
        """Yield the results of a batch that is done; the tasks of one that is not go on, or are blamed."""
        if future.status in ("cancelled", "lost"):
            batches.again(future)
        elif future.status in ("finished", "error"):
            outcome = _outcome(future)
            if not isinstance(outcome, BaseException):
                yield from zip(batches.take(future), outcome, strict=True)
            elif batches.is_single(future) or isinstance(outcome, _library().KilledWorker):
                # No error of a task, which a batch catches: its result went with a cluster that was lost, or cannot
                # be sent. Of a worker that died Dask blames all tasks that waited for it.
                self._blamed.extend(batches.take(future))
            else:
                batches.again(future, alone=True)


class _Batches(Generic[Task]):
    """Tasks that are left, and the batches of them that a cluster has."""

    def __init__(self, left: list[Task], under_way: dict[Any, list[Task]]) -> None:
        self._left = left
        self._under_way = under_way
        self._begun = 0
        self._alone: set[int] = set()

    def fill(self, submit: Callable[[list[Task]], Any], threads: int) -> bool:
        """Give the cluster so many batches that no thread waits for one; return whether it takes them."""
        left = self._left
        while left and len(self._under_way) < max(1, threads) * (1 + _AHEAD):
            # A batch that could not be read goes on in single tasks.
            many = 1 if id(left[-1]) in self._alone else batch_size(len(left), threads, self._begun)
            self._begun += many
            batch = left[: -many - 1 : -1]
            try:
                future = submit(batch)
            except Exception:  # noqa: BLE001 - a client whose scheduler is gone says so in many ways
                return False
            del left[-many:]
            self._under_way[future] = batch
        return True

    def is_single(self, future: Any) -> bool:
        """Whether a batch is one task."""
        return len(self._under_way[future]) == 1

    def take(self, future: Any) -> list[Task]:
        """Return the tasks of a batch that is done."""
        return self._under_way.pop(future)

    def again(self, future: Any, *, alone: bool = False) -> None:
        """Leave the tasks of a batch for others, or each for one of its own."""
        batch = self._under_way.pop(future)
        if alone:
            self._alone.update(map(id, batch))
        self._left.extend(reversed(batch))


class _Standing:
    """How many threads the cluster has; asking after each batch would cost the scheduler as much as the batch.

    Attributes:
        threads: of all workers.
        on_one_host: threads that share a machine, where most do; 0 where there are none.
    """

    def __init__(self, client: Any, clock: Callable[[], float]) -> None:
        self._client = client
        self._clock = clock
        self._looked = self._seen = clock()
        self._count()

    @property
    def absent_s(self) -> float:
        """Seconds since it had any, as of the last look."""
        return self._looked - self._seen

    def look(self, *, at_once: bool) -> None:
        """Ask for them, where the last answer is old, was none, or something was lost."""
        now = self._clock()
        if self.threads and not at_once and now - self._looked < _LOOK_S:
            return
        self._count()
        self._looked = now
        if self.threads:
            self._seen = now

    def _count(self) -> None:
        counted = _threads(self._client)
        self.threads = sum(counted.values())
        self.on_one_host = max(counted.values(), default=0)


def _outcome(future: Any) -> Any:
    """Return the result of a task, or the error that ended it."""
    try:
        error = future.exception() if future.status == "error" else None
        outcome = future.result() if error is None else error
    except Exception as broken:  # noqa: BLE001 - a result that cannot be read is an error of its task
        outcome = broken
    # What is read is let go of at once: the cluster holds nothing that is not needed.
    future.release()
    return outcome


def _threads(client: Any) -> Counter[str]:
    """Return how many threads the cluster has now on each host; none where it does not answer."""
    counted: Counter[str] = Counter()
    if client.status == "running":
        # A scheduler that is gone fails in many ways.
        with suppress(Exception):
            for address, threads in client.nthreads().items():
                counted[_host_and_port(address)[0]] += threads
    return counted


def _host_and_port(address: str) -> tuple[str, str]:
    host, _, port = address.partition("://")[2].rpartition(":")
    return host.strip("[]"), port


def _reaches_workers(client: Any) -> bool:
    """Return whether this process can connect to all workers; firewalls and networks of containers may prevent it."""
    try:
        for address in client.nthreads():
            host, port = _host_and_port(address)
            with socket.create_connection((host, int(port)), timeout=_REACH_S):
                pass
    except Exception:  # noqa: BLE001 - so does a scheduler that is gone, in many ways
        return False
    return True


def fit_client(address: str, folder: str, *, connect_s: float = 10.0, prepare: Callable[[], None] | None = None) -> Any:
    """Return a connection to a cluster whose workers do the work as this process would.

    Args:
        address: of the scheduler.
        folder: that workers have to see; empty for none.
        connect_s: seconds within which the scheduler has to answer.
        prepare: is called on each worker; None for nothing.

    Raises:
        UsageError: the cluster cannot be reached, or its workers are not fit for the work.
    """
    client = _connected(address, connect_s)
    for left in reversed(range(_TRIES)):
        try:
            _check(client, folder)
            if prepare is not None:
                client.run(prepare)
        except (OSError, RuntimeError, *_CANCELLED) as error:
            # A worker that was lost meanwhile is no fault of the others.
            if left and client.status == "running":
                continue
            _let_go(client)
            raise _not_reached(address, error) from error
        except BaseException:
            _let_go(client)
            raise
        break
    return client


def _let_go(client: Any) -> None:
    with suppress(Exception):
        client.close(timeout=5)


def _not_reached(address: str, error: BaseException) -> UsageError:
    return UsageError(
        f"the scheduler {address!r} cannot be reached: {' '.join(str(error).split())[:200] or 'no answer'}",
        expected="the address of a scheduler of Dask that runs",
        advice="Start one with `dask scheduler`, and workers with `dask worker ADDRESS`",
    )


def _silence() -> None:
    """Have Dask print nothing here, unless the user configured what: results say what was lost, and why."""
    import dask

    if dask.config.get("logging", default=None) is None:
        for name in list(logging.root.manager.loggerDict):
            if name.partition(".")[0] in ("distributed", "tornado"):
                logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _library() -> Any:
    import distributed

    return distributed


def _connected(address: str, connect_s: float) -> Any:
    try:
        distributed = _library()
    except ImportError as error:
        raise UsageError(
            "Dask is not installed",
            expected="roslens[dask]",
            advice="Install it with `pip install roslens[dask]`, here and on the workers",
        ) from error
    _silence()
    try:
        client = distributed.Client(address, timeout=connect_s, set_as_default=False)
    except (OSError, ValueError, RuntimeError, TimeoutError) as error:
        raise _not_reached(address, error) from error
    return client


def _check(client: Any, folder: str) -> None:
    """Refuse a cluster whose workers cannot do the work as this process would.

    Raises:
        UsageError: it has none, or one has another roslens, or does not see the folder.
    """
    try:
        client.wait_for_workers(1, timeout=30)
        versions = client.run(analyser_version)
        sees = client.run(os.path.isdir, folder) if folder else {}
    except TimeoutError as error:
        raise UsageError(
            "the cluster has no workers", expected="at least one", advice="Start some with `dask worker ADDRESS`"
        ) from error
    except (ImportError, AttributeError) as error:
        raise UsageError(
            f"a worker cannot import roslens: {error}", expected="the same roslens on every worker"
        ) from error
    mine = analyser_version()
    if others := sorted(worker for worker, version in versions.items() if version != mine):
        raise UsageError(
            f"another roslens is installed where worker {others[0]} runs", expected="the same on every worker"
        )
    if blind := sorted(worker for worker, found in sees.items() if not found):
        raise UsageError(
            f'worker {blind[0]} does not see "{folder}"',
            expected="a folder that all workers and this process have under the same path",
        )
