"""Several tasks as one, for engines to which each task has a price of its own: a message, a line in a book."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from roslens.source.engines.cluster_readers import ask_limited, lent_reader
from roslens.source.engines.task_limits import TaskLimits

Task = TypeVar("Task")
Result = TypeVar("Result")

MOST = 16
"""Tasks of one batch: what a lost worker has to do again, and what is held of results at once."""

_ROUNDS = 12
"""Batches that each thread still gets, if all were as large as the next one: the last ones are small, so that all
threads end together."""


def batch_size(left: int, threads: int, begun: int = MOST * _ROUNDS) -> int:
    """Return how many tasks go into the next batch; at least 1.

    Tasks come largest first: the first ones go alone, so that one thread does not get all the large ones.

    Args:
        left: tasks that are in no batch yet.
        threads: of the cluster.
        begun: tasks that are in one.
    """
    threads = max(1, threads)
    return max(1, min(MOST, left // (_ROUNDS * threads), 1 + begun // (2 * threads)))


def run_batch(
    function: Callable[[Task], Result], limits: TaskLimits, root: str, tasks: Sequence[Task]
) -> list[Result | Exception]:
    """Return the result of each task, or the exception that ended it, in their order; the limits are those of each.

    They are done in a process of their own, which this one watches.

    Args:
        function: of a module that can be imported here.
        limits: of each task.
        root: folder to which paths of files are relative.
        tasks: can be pickled.
    """
    found: list[Result | Exception] = []
    with lent_reader(root) as reader:
        for task in tasks:
            try:
                found.append(ask_limited(reader, function, limits, task))
            except Exception as error:  # noqa: BLE001 - one task's error is a result, the others go on
                found.append(error)
    return found
