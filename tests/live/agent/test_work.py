"""How often an agent counts: by what counting takes, not by how long it waits for its turn."""

import socket

import pytest

from roslens.live.agent.host import HostSampler
from roslens.live.agent.processes import ProcessSampler
from roslens.live.agent.work import COUNT_AT_LEAST_EVERY_S, COUNT_EVERY_S, Agent


class Clock:
    def __init__(self):
        self.now = 1000.0

    def __call__(self):
        return self.now


class Counters:
    """Takes so much CPU time and so much time to be read."""

    def __init__(self, cpu, steady, *, work, wait):
        self.cpu, self.steady, self.work, self.wait = cpu, steady, work, wait
        self.reads = []

    def read(self, now):
        self.reads.append(self.steady.now)
        self.cpu.now += self.work
        self.steady.now += self.work + self.wait
        return []

    def calls(self, now):
        return []

    def nodes(self):
        return {}

    def places(self):
        return []

    def failures(self):
        return []

    def close(self):
        pass


@pytest.mark.parametrize(
    ("work", "wait", "every"),
    [
        (0.001, 0.0, COUNT_EVERY_S),
        (0.001, 0.06, COUNT_EVERY_S),  # others keep the host busy
        (0.004, 0.0, 0.4),
        (0.5, 0.0, COUNT_AT_LEAST_EVERY_S),
    ],
)
def test_counting_is_rarer_where_it_takes_more_and_not_where_it_waits(tmp_path, work, wait, every):
    (tmp_path / "proc").mkdir()
    steady, cpu = Clock(), Clock()
    counters = Counters(cpu, steady, work=work, wait=wait)
    with socket.create_server(("127.0.0.1", 0)) as server:
        agent = Agent(
            "base",
            HostSampler("base", proc=tmp_path / "proc", sys=tmp_path),
            ProcessSampler("base", proc=tmp_path / "proc"),
            address=server.getsockname(),
            key=b"k" * 32,
            wall=steady,
            steady=steady,
            period_s=0.001,
            counters=counters,
            spent=cpu,
        )
        try:
            while len(counters.reads) < 6:
                agent.step()
                steady.now += 0.005
        finally:
            agent.close()
    spaces = [late - early for early, late in zip(counters.reads[1:], counters.reads[2:], strict=False)]
    assert spaces == pytest.approx([every] * len(spaces), abs=max(work, 0.011))
