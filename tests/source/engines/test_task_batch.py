from roslens.source.engines.task_batch import MOST, batch_size, run_batch
from roslens.source.engines.task_limits import TaskLimits


def test_the_last_batches_are_small():
    sizes, left = [], 4000
    while left:
        sizes.append(batch_size(left, 2))
        left -= sizes[-1]
    assert sizes[0] == MOST
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-20:] == [1] * 20
    assert len(sizes) < 4000 / 10


def test_the_first_and_largest_tasks_go_alone():
    sizes, begun = [], 0
    while begun < 4000:
        sizes.append(batch_size(4000 - begun, 2, begun))
        begun += sizes[-1]
    assert sizes[:4] == [1] * 4
    assert sizes[:40] == sorted(sizes[:40])
    assert max(sizes) == MOST
    assert len(sizes) < 4000 / 10


def test_few_tasks_are_a_batch_each():
    assert batch_size(23, 2) == 1
    assert batch_size(5, 0) == 1


def test_each_task_has_its_own_result_or_error():
    free = TaskLimits(seconds=0, memory_bytes=0)
    one, two, three = run_batch(int, free, "", ["1", "two", "3"])
    assert (one, three) == (1, 3)
    assert isinstance(two, ValueError)
