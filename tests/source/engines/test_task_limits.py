"""What one task may take."""

import pytest

from roslens.source.engines.executor import ProcessPool
from roslens.source.engines.task_limits import TaskLimits, run_limited


def test_without_a_bound_it_is_the_function():
    assert run_limited(int, TaskLimits(seconds=0, memory_bytes=0), "7") == 7


def test_an_error_of_the_function_is_handed_on():
    with pytest.raises(ValueError, match="seven"):
        run_limited(int, TaskLimits(memory_bytes=0), "seven")


def test_a_task_that_takes_too_long_is_lost_and_the_others_are_not():
    slow = "__import__('time').sleep(60)"
    results = dict(ProcessPool(2, TaskLimits(seconds=0.3)).run(eval, ["1", slow, "3", *map(str, range(10, 20))]))
    assert "may take 0.3 s" in str(results.pop(slow))
    assert results == {text: int(text) for text in results}
    assert len(results) == 12


def test_a_task_that_takes_too_much_memory_is_an_error_of_its_own():
    greedy = "len(bytearray(2_000_000_000))"
    results = dict(ProcessPool(1, TaskLimits(memory_bytes=1_000_000_000)).run(eval, [greedy, "7"]))
    assert isinstance(results.pop(greedy), MemoryError)
    assert results == {"7": 7}


def test_no_more_is_under_way_than_keeps_workers_busy():
    taken = []

    def tasks():
        for number in range(100):
            taken.append(number)
            yield str(number)

    class Counted(list):
        def __iter__(self):
            return tasks()

        def __len__(self):
            return 100

    run = ProcessPool(2)._run_pool(int, Counted(), [], [])
    next(run)
    assert len(taken) <= 8
    assert len(list(run)) == 99
