import subprocess
import sys

import pytest

from roslens.live.agent.host import HostSampler
from roslens.live.agent.processes import ProcessSampler
from roslens.live.local_host import LocalHost
from roslens.model.graph import Change


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
        gone = []
        while not gone:
            gone = [event for one in local.poll(10.0) for event in one.events if event.change is Change.VANISHED]
    assert gone[0].entity == f"process:here/{child.pid}"
