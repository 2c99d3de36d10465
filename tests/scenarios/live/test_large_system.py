"""200 nodes and 1,000 topics: all of them are seen, soon, and what that costs is bounded; a quarter of it each day."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest
import yaml
from pace import slowness
from ros2_domain import own_domain

from testbed import robot_ros1, robot_ros2

pytestmark = [pytest.mark.real, pytest.mark.slow]

HERE = Path(__file__).parent
ROSLENS = Path(sys.executable).parent / "roslens"
NODES, TOPICS = 200, 5
PROCESSES = 4
KINDS = ("Header", "String", "Float64")
TICKS = os.sysconf("SC_CLK_TCK")
PAGE = os.sysconf("SC_PAGE_SIZE")
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@pytest.fixture(autouse=True, params=[48, pytest.param(NODES, marks=pytest.mark.nightly)])
def size(request, monkeypatch):
    monkeypatch.setitem(globals(), "NODES", request.param)


def names():
    return {f"/large/g{number % 10}/n{number}" for number in range(NODES)}


def ends():
    """Return of each topic its type and the names of its publisher and of its subscriber."""
    name = [f"/large/g{number % 10}/n{number}" for number in range(NODES)]
    return {
        f"/large/t{number}_{topic}": (KINDS[topic % 3], name[number], name[number - 1])
        for number in range(NODES)
        for topic in range(TOPICS)
    }


@pytest.fixture
def reference(tmp_path):
    """A sentence for each node and each topic, whose verdict tells when it was first seen."""
    document = tmp_path / "large.yaml"
    lines = [f"  - {{node: {name}, expected: always, grace: 60 s}}" for name in sorted(names())]
    lines += [f"  - {{topic: {name}, expected: always, grace: 60 s}}" for name in sorted(ends())]
    document.write_text("kind: reference\nname: large\nconstraints:\n" + "\n".join(lines) + "\n")
    return document


@contextmanager
def running(*command, environment):
    process = subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        yield process
    finally:
        # Asked first: roscore starts its master in a session of its own, which nobody else ends.
        os.killpg(process.pid, signal.SIGINT)
        with suppress(subprocess.TimeoutExpired):
            process.wait(10)
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(20)
        process.stdout.close()


class Cost:
    """Processor time and memory of a program and of what it has started."""

    def __init__(self, pid):
        self._pid = pid
        self.seconds = {}
        self.megabytes = {}

    def look(self):
        children = Path(f"/proc/{self._pid}/task/{self._pid}/children")
        try:
            pids = [self._pid, *map(int, children.read_text().split())]
        except OSError:
            return
        for number, pid in enumerate(pids):
            try:
                fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            part = "monitor" if number == 0 else "observer"
            self.seconds[part] = max(self.seconds.get(part, 0.0), (int(fields[11]) + int(fields[12])) / TICKS)
            self.megabytes[part] = max(self.megabytes.get(part, 0.0), int(fields[21]) * PAGE / 1e6)


def watch(words, environment, folder, least):
    """Watch until everything was told to be there, and `least` seconds at least, so that what it costs can be told.

    Return the lines, the graph, the cost, when it began and how long it took; how long it may take is the test's limit.
    """
    out, graph = folder / "watch.json", folder / "graph.yaml"
    command = [str(ROSLENS), "watch", *words, "--format", "json", "--graph-out", str(graph)]
    began = time.time()
    with out.open("w") as lines:
        process = subprocess.Popen(command, env=environment, stdout=lines, start_new_session=True)
    cost, wanted, reported, line = Cost(process.pid), entities(), out.open(), ""
    try:
        while process.poll() is None:
            cost.look()
            while piece := reported.readline():
                line += piece
                if not line.endswith("\n"):  # the rest is being written
                    break
                one, line = json.loads(line), ""
                if one["is"] == "verdict" and one["state"] == "ok":
                    wanted.discard(one["entity"])
            if not wanted and time.time() - began >= least:
                break
            time.sleep(0.1)
        length = time.time() - began
        process.send_signal(signal.SIGINT)
        process.wait(60)
    finally:
        reported.close()
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait(20)
    said = [json.loads(line) for line in out.read_text().splitlines()]
    assert process.returncode == 0, [one for one in said if one["is"] not in ("event", "verdict")]
    with graph.open() as stream:
        return said, yaml.load(stream, LOADER), cost, began, length


def entities():
    return {f"node:{name}" for name in names()} | {f"topic:{name}" for name in ends()}


def judged(said, written, cost, began, length, generation, capsys):
    """Everything is there with type and ends, everything is told to be there and nothing to have gone."""
    seen = {
        (end["name"], end["type"]["name"].split("/")[-1], node["name"], role)
        for node in written["nodes"]
        for role in ("publishers", "subscriptions")
        for end in node[role]
        if end["name"].startswith("/large/t")
    }
    assert names() <= {node["name"] for node in written["nodes"]}
    wanted = ends()
    assert seen == {(topic, kind, node, "publishers") for topic, (kind, node, _) in wanted.items()} | {
        (topic, kind, node, "subscriptions") for topic, (kind, _, node) in wanted.items()
    }
    verdicts = [one for one in said if one["is"] == "verdict"]
    fine = {one["entity"]: one["time"] for one in verdicts if one["state"] == "ok"}
    assert entities() <= fine.keys()
    assert [one for one in verdicts if one["state"] not in ("ok", "unknown")] == []
    gone = [one for one in said if one["is"] == "event" and one["change"] == "vanished" and "/large/" in one["entity"]]
    assert gone == []
    complete = max(fine.values()) - began
    parts = ", ".join(
        f"{part} {100 * cost.seconds[part] / length:.0f} % of a core, {cost.megabytes[part]:.0f} MB"
        for part in sorted(cost.seconds)
    )
    with capsys.disabled():
        sys.stdout.write(f"\n{generation}: complete after {complete:.1f} s; {parts}; load {os.getloadavg()[0]:.0f}\n")
    return complete


def cheap(cost, began, length, **shares):
    """Each part took no more than this share of a core of a calm machine, and no more memory than it may."""
    for part, share in shares.items():
        assert cost.seconds[part] < share * length * slowness(), part
    assert max(cost.megabytes.values()) < 250


BARE = """
import rclpy, sys, time
begun = time.time()
rclpy.init()
node = rclpy.create_node("bare")
seen = lambda names, start: sum(name.startswith(start) for name in names)
while (
    seen((space for _, space in node.get_node_names_and_namespaces()), "/large/") < int(sys.argv[1])
    or seen((name for name, _ in node.get_topic_names_and_types()), "/large/t") < int(sys.argv[2])
):
    time.sleep(0.25)
print(time.time() - begun, flush=True)
"""


@pytest.mark.timeout(240)
def test_every_node_and_topic_of_a_large_ros2_is_seen(tmp_path, reference, capsys):
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    python = robot_ros2.python()
    environment = {
        **os.environ,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROSLENS_COUNTERS": str(tmp_path / "counters"),
        "ROSLENS_ROS2_PYTHON": python,
    }
    share = NODES // PROCESSES
    with ExitStack() as stack:
        started = [
            stack.enter_context(
                running(
                    str(ROSLENS), "run", "--", python, str(HERE / "many_ros2.py"),
                    str(first), str(share), str(TOPICS), str(NODES), environment=environment,
                )
            )
            for first in range(0, NODES, share)
        ]  # fmt: skip
        for one in started:
            assert one.stdout.readline() == b"there\n"
        # When others see everything that roslens shall see, at the same time on the same machine.
        bare = stack.enter_context(running(python, "-c", BARE, str(NODES), str(len(ends())), environment=environment))
        found = watch(["--ros2", "--reference", str(reference)], environment, tmp_path, 8 + NODES / 8)
        others = float(bare.stdout.readline())
    assert judged(*found, "ROS 2", capsys) < others + 10 * slowness()
    cheap(*found[2:], monitor=0.6, observer=0.4)


@pytest.mark.timeout(240)
@pytest.mark.skipif(not shutil.which("roscore"), reason="roscore is not installed")
def test_every_node_and_topic_of_a_large_ros1_is_seen(tmp_path, reference, capsys):
    if reason := robot_ros1.why_not():
        pytest.skip(reason)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    master = f"http://127.0.0.1:{port}"
    environment = {
        **os.environ,
        "ROS_MASTER_URI": master,
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(tmp_path / "home"),
        "ROS_LOG_DIR": str(tmp_path / "log"),
    }
    real = "/usr/lib/topic_tools/relay"
    with running("roscore", "-p", str(port), environment=environment) as core:
        until_open(port, core)
        many = running(
            sys.executable, str(HERE / "many_ros1.py"), master, str(NODES), str(TOPICS), environment=environment
        )
        relay = running(real, "/large/t0_0", "/relayed", "__name:=relay", environment=environment)
        with many as one, relay:
            assert one.stdout.readline() == b"there\n"
            found = watch(["--ros1", "--reference", str(reference)], environment, tmp_path, 8 + NODES / 20)
    # One that is real is among them; it is no part of what is expected.
    nodes = {node["name"]: node for node in found[1]["nodes"]}
    assert [end["name"] for end in nodes["/relay"]["subscriptions"]] == ["/large/t0_0"]
    nodes["/relay"]["subscriptions"].clear()
    assert judged(*found, "ROS 1", capsys) < 15 * slowness()
    cheap(*found[2:], monitor=0.6, observer=0.6)


def until_open(port, core, seconds=30.0):
    end = time.monotonic() + seconds
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 1.0).close()
            return
        except OSError:
            assert time.monotonic() < end
            assert core.poll() is None
            time.sleep(0.05)
