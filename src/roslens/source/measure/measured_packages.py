"""Packages measured by an engine: here, or in other processes, where all that crosses between them is packed.

Pickling the same values takes several times as long as msgspec does, and half of that in the one process that all
results come to.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import partial

import msgspec

from roslens.model.failure import Failure
from roslens.source.engines.executor import InProcess
from roslens.source.engines.task_engine import Executor
from roslens.source.measure.analyse_package import MeasuredPackage, measure_task
from roslens.source.measure.finished_package import FinishedPackage, Finishing, finish_packed
from roslens.source.measure.package_task import PackageTask
from roslens.source.measure.remembered_facts import RememberedFacts

_PACK = msgspec.msgpack.Encoder()
_TASK = msgspec.msgpack.Decoder(PackageTask)
_RESULT = msgspec.msgpack.Decoder(MeasuredPackage)
_FINISHED = msgspec.msgpack.Decoder(FinishedPackage)

Looked = MeasuredPackage | FinishedPackage


def measured_packages(
    executor: Executor,
    tasks: Sequence[PackageTask],
    remembered: RememberedFacts | None = None,
    finishing: Finishing | None = None,
) -> Iterator[tuple[PackageTask, Looked | BaseException]]:
    """Yield each task with what was measured, or with what ended it, in the order in which they are done.

    Args:
        executor: runs them.
        tasks: packages to measure.
        remembered: files of an earlier look in this process; only of use there.
        finishing: how packages are finished where they were measured, which is not this process; None where that is
            left to this one.
    """
    if isinstance(executor, InProcess):
        yield from executor.run(partial(measure_task, remembered=remembered), tasks)
        return
    by_packed = {_PACK.encode(task): task for task in tasks}
    if finishing is None:
        for packed, result in executor.run(measure_packed, list(by_packed)):
            yield by_packed[packed], result if isinstance(result, BaseException) else _RESULT.decode(result)
        return
    # Few packages have failures, and each takes its own along.
    how = _PACK.encode(msgspec.structs.replace(finishing, failures=()))
    failures: dict[str, list[Failure]] = defaultdict(list)
    for one in finishing.failures:
        failures[one.package].append(one)
    pairs = [(_PACK.encode(failures.get(task.package.id, ())), packed) for packed, task in by_packed.items()]
    for pair, result in executor.run(partial(_finish, how), pairs):
        yield by_packed[pair[1]], result if isinstance(result, BaseException) else _FINISHED.decode(result)


def measure_packed(packed: bytes) -> bytes:
    """Measure a package in another process."""
    return _PACK.encode(measure_task(_TASK.decode(packed)))


def _finish(how: bytes, pair: tuple[bytes, bytes]) -> bytes:
    return finish_packed(how, *pair)
