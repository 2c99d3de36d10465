"""Samples of a host, process or node over a window."""

from __future__ import annotations

from roslens.live.system.sampled import Sampled
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample

LIDAR = EntityId(EntityKind.NODE, "/lidar")


def take(sampled: Sampled, time: float, **values: float) -> None:
    """Give a sample."""
    sampled.add(Sample(LIDAR, time, values), values)
    sampled.settle(time)


def test_a_process_that_was_started_again_has_no_load_over_a_window_yet():
    sampled = Sampled(LIDAR, 0.0)
    sampled.keep(5.0)
    for second in range(10):
        take(sampled, float(second), cpu=4.0, memory=8e7)
    assert sampled.value("cpu", 5.0, 0.0, 9.0) == 4.0
    # Its first sample has no load: that is known from the second on. The newest before are as old as the window.
    take(sampled, 14.0, memory=7e7)
    assert sampled.value("cpu", 5.0, 0.0, 14.0) is None
    assert sampled.value("cpu", 5.0, 95.0, 14.0) is None
    assert sampled.value("memory", 5.0, 0.0, 14.0) == 7e7
    take(sampled, 15.0, cpu=2.0, memory=7e7)
    assert sampled.value("cpu", 5.0, 0.0, 15.0) == 2.0
