"""What faults do to the messages of a stretch, and to nothing else."""

import numpy as np
import pytest

from roslens.live.mutation.fault import Fault, FaultKind, changed, wrong_value

SECOND = 1_000_000_000
TIMES = np.arange(0, 20 * SECOND, SECOND // 10, dtype=np.int64)
SIZES = np.arange(len(TIMES), dtype=np.int64)
INSIDE = (TIMES >= 5 * SECOND) & (TIMES < 10 * SECOND)


def after(kind, stamps=None):
    return changed(Fault(kind, "/scan", "/lidar", 5.0, 10.0), (TIMES, SIZES, stamps))


@pytest.mark.parametrize(
    ("kind", "left"),
    [
        (FaultKind.RATE_HALVED, range(25, 26)),
        (FaultKind.GAP, range(45, 46)),
        (FaultKind.DROP_OUT, range(33, 47)),
        (FaultKind.DELAY, range(50, 51)),
        (FaultKind.WRONG_VALUE, range(50, 51)),
        (FaultKind.DEAD_PUBLISHER, range(1)),
        (FaultKind.VANISHED_NODE, range(1)),
    ],
)
def test_how_many_messages_are_left_in_the_stretch(kind, left):
    _, sizes, _ = after(kind)
    assert sum(INSIDE[sizes]) in left
    assert sum(~INSIDE[sizes]) == sum(~INSIDE)


def test_what_is_late_keeps_its_stamp_and_its_size():
    times, sizes, stamps = after(FaultKind.DELAY, TIMES)
    assert (np.diff(times) >= 0).all()
    late = {int(t - s) for t, s in zip(times, stamps, strict=True)}
    assert late == {0, SECOND // 2}
    assert (TIMES[sizes] == stamps).all()


def test_a_gap_of_a_slow_topic_is_longer_than_its_period():
    slow = np.arange(0, 20 * SECOND, SECOND, dtype=np.int64)
    times, _, _ = changed(Fault(FaultKind.GAP, "/slow", "", 5.0, 15.0), (slow, slow, None))
    assert max(np.diff(times)) == 6 * SECOND


def test_a_dead_publisher_takes_all_its_topics_with_it_where_it_is_known():
    fault = Fault(FaultKind.DEAD_PUBLISHER, "/scan", "/lidar", 0.0, 1.0)
    assert fault.concerns("/points", "/lidar")
    assert not fault.concerns("/scan", "/other")
    unknown = Fault(FaultKind.DEAD_PUBLISHER, "/scan", "", 0.0, 1.0)
    assert unknown.concerns("/scan", "")
    assert not unknown.concerns("/points", "")
    assert not Fault(FaultKind.GAP, "/scan", "/lidar", 0.0, 1.0).concerns("/points", "/lidar")


@pytest.mark.parametrize("values", [[0.0], [-5.0, 5.0], [1e9], [0.1, 0.2]])
def test_a_wrong_value_is_far_from_all_that_were_there(values):
    wrong = wrong_value(np.array(values))
    assert wrong - max(values) >= max(10.0, 10 * (max(values) - min(values)))
