import os
import subprocess
import sys

import pytest

from roslens.live.agent.host import HostSampler
from roslens.live.agent.processes import ProcessSampler
from roslens.live.inside import slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.host_counters import HostCounters, place_of
from roslens.live.inside.slots import VARIABLE
from roslens.live.observe.local_host import LocalHost
from roslens.model.graph import Change, Event, Process


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def local(clock):
    made = LocalHost("here", HostSampler("here"), ProcessSampler("here"), wall=clock, steady=clock)
    yield made
    made.close()


def test_a_frame_when_it_is_due(local, clock):
    (frame,) = local.poll()
    assert str(frame.samples[0].entity) == "host:here"
    assert frame.graph.hosts == ("here",)
    clock.now += 0.5
    assert not any(one.samples for one in local.poll())
    clock.now += 0.5
    assert local.poll()[0].samples[0].time == 101.0


def test_the_end_of_a_process_is_told_at_once(local):
    program = "import sys; print(flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", program, "--ros-args"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        child.stdout.readline()
        (frame,) = local.poll()
        assert f"process:here/{child.pid}" in {event.entity for event in frame.events}
        child.kill()
        gone = set()
        # Others on this machine may end as well.
        while f"process:here/{child.pid}" not in gone:
            gone |= {
                event.entity for one in local.poll(10.0) for event in one.events if event.change is Change.VANISHED
            }


def test_who_counts_here_is_told_and_what_they_count_is_left_to_the_observer_of_their_domain(tmp_path, clock):
    folder = tmp_path / "counters"
    folder.mkdir(0o700)
    counters = HostCounters("here", {VARIABLE: str(folder)}, beside=True)
    local = LocalHost(
        "here", HostSampler("here"), ProcessSampler("here"), wall=clock, steady=clock, counters=counters,
        identities=lambda: ("78fd",),
    )  # fmt: skip
    file = CounterFile(str(folder), 8)
    local.name("here", frozenset({os.getpid()}))
    assert local.poll()[0].graph.identities == {"here": ("78fd",)}
    for kind in (slots.PUBLISHED, slots.ASKED):
        file.slot(kind, b"", "/x", "/node").published(int(clock.now * 1e9), 10)
    clock.now += 1.0
    first, *others = local.poll()
    assert [process.nodes for process in first.graph.processes if process.pid == os.getpid()] == [("/node",)]
    assert [(frame.sender, frame.counted_at, frame.tallies) for frame in others] == [
        ("here/monitor", place_of(str(folder)), [])
    ]
    assert others[0].samples == []
    local.close()
    file.close()


@pytest.mark.parametrize("ended_after", [1, 2, 3])
def test_processes_are_looked_for_every_second_sample_however_many_frames_go(tmp_path, clock, monkeypatch, ended_after):
    """Where a process ended, another one begins: that one has to be found, as often as that happens."""
    looked = []
    processes = ProcessSampler("here")
    monkeypatch.setattr(processes, "find", lambda now: looked.append(now) or [])
    place = tmp_path / "counters"
    CounterFile(str(place), 64).close()
    counters = HostCounters("here", {VARIABLE: str(place)}, beside=True)
    made = LocalHost("here", HostSampler("here"), processes, wall=clock, steady=clock, counters=counters)
    ends = [[], [Event(0.0, Change.VANISHED, "process:here/1")]]
    for second in range(12):
        monkeypatch.setattr(made, "_ended", lambda _, at=second: ends[at == ended_after])
        clock.now = 100.0 + second - (0.5 if second == ended_after else 0.0)
        made.poll()
        clock.now = 100.0 + second
        monkeypatch.setattr(made, "_ended", lambda _: [])
        made.poll()
    made.close()
    assert looked == [100.0 + second for second in range(0, 12, 2)]


def test_the_graph_is_told_where_it_is_another_than_before(tmp_path, clock, monkeypatch):
    folder = tmp_path / "counters"
    folder.mkdir(0o700)
    counters = HostCounters("here", {VARIABLE: str(folder)}, beside=True)
    processes = ProcessSampler("here")
    monkeypatch.setattr(processes, "find", lambda now: [])
    monkeypatch.setattr(processes, "processes", lambda: (Process("here", os.getpid()),))
    local = LocalHost("here", HostSampler("here"), processes, wall=clock, steady=clock, counters=counters)
    file = CounterFile(str(folder), 8)
    told = []
    for node in ("", "/node", "", "/other", ""):
        if node:
            file.slot(slots.PUBLISHED, b"", "/x", node)
        told.append([frame.graph.processes[0].nodes for frame in local.poll() if frame.graph is not None])
        clock.now += 1.0
    assert told == [[()], [("/node",)], [], [("/node", "/other")], []]
    local.close()
    file.close()
