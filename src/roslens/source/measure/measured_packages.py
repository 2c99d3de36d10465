"""Packages measured by an engine: here, or in other processes, where all that crosses between them is packed.

Pickling the same values takes several times as long as msgspec does, and half of that in the one process that all
results come to.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import msgspec

from roslens.source.engines.executor import InProcess
from roslens.source.engines.task_engine import Executor
from roslens.source.measure.analyse_package import MeasuredPackage, measure_task
from roslens.source.measure.package_task import PackageTask
from roslens.source.measure.remembered_facts import RememberedFacts

_PACK = msgspec.msgpack.Encoder()
_TASK = msgspec.msgpack.Decoder(PackageTask)
_RESULT = msgspec.msgpack.Decoder(MeasuredPackage)


def measured_packages(
    executor: Executor, tasks: Sequence[PackageTask], remembered: RememberedFacts | None = None
) -> Iterator[tuple[PackageTask, MeasuredPackage | BaseException]]:
    """Yield each task with what was measured, or with what ended it, in the order in which they are done.

    Args:
        executor: runs them.
        tasks: packages to measure.
        remembered: files of an earlier look in this process; only of use there.
    """
    if isinstance(executor, InProcess):
        yield from executor.run(partial(measure_task, remembered=remembered), tasks)
        return
    by_packed = {_PACK.encode(task): task for task in tasks}
    for packed, result in executor.run(measure_packed, list(by_packed)):
        yield by_packed[packed], result if isinstance(result, BaseException) else _RESULT.decode(result)


def measure_packed(packed: bytes) -> bytes:
    """Measure a package in another process."""
    return _PACK.encode(measure_task(_TASK.decode(packed)))
