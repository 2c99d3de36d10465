"""Real processes that are ended and started again."""

import os
import queue
import signal
import subprocess
import sys
import time

import pytest

from roslens.judge.patterns.pattern import Pattern
from roslens.live.agent.allow_list import AllowedCommand, AllowedNodes, AllowList
from roslens.live.agent.host_hand import HostHand
from roslens.live.agent.process_record import ProcessRecords, record
from roslens.model.acting.host_request import HostRequest

pytestmark = pytest.mark.timed

WAIT_S = 30.0
NODE = """
import os, signal, sys, time
if {deaf}:
    for one in (signal.SIGINT, signal.SIGTERM): signal.signal(one, signal.SIG_IGN)
print(os.getpid(), os.getcwd(), os.environ.get('ROLE'), sys.argv[1:], flush=True)
while True: time.sleep(60)
"""
ALLOW = AllowList(
    (AllowedNodes(Pattern.parse("/driver*"), frozenset({"stop", "restart", "start", "kill"})),),
    {
        "hello": AllowedCommand((sys.executable, "-c", "print('hi; $HOME'); print('bye')"), 20.0),
        "fails": AllowedCommand((sys.executable, "-c", "raise SystemExit(3)"), 20.0),
        "slow": AllowedCommand((sys.executable, "-c", "import time; time.sleep(60)"), 0.3),
    },
)


class Scene:
    """A host's hand, and nodes that end with the test."""

    def __init__(self, folder):
        self.folder = folder
        self.reported = queue.SimpleQueue()
        self.announced = []
        self.held = ""
        self.records = ProcessRecords()
        self.hand = HostHand(
            ALLOW,
            self.records,
            self.reported.put,
            announce=self.announced.append,
            output=folder / "nodes",
            held=lambda: self.held,
        )
        self.nodes = []

    def node(self, *, deaf=False):
        place = self.folder / "work"
        place.mkdir(exist_ok=True)
        command = [sys.executable, "-c", NODE.format(deaf=deaf), "__name:=driver", "a b"]
        process = subprocess.Popen(
            command, cwd=place, env={"ROLE": "driver", "PATH": os.environ["PATH"]}, stdout=subprocess.PIPE, text=True
        )
        process.stdout.readline()
        self.nodes.append(process)
        self.records.keep([process.pid])
        return process

    def ask(self, kind, node="/driver", pid=0, beside=(), **arguments):
        self.hand.begin(HostRequest("r/1.1", kind, node, pid, beside, arguments))
        return self.reported.get(timeout=WAIT_S)

    def printed(self):
        end = time.monotonic() + WAIT_S
        while time.monotonic() < end:
            lines = (self.folder / "nodes" / "driver.log").read_text().splitlines()
            if lines:
                return lines[-1]
            time.sleep(0.02)
        raise AssertionError("nothing was printed")

    def close(self):
        for process in self.nodes:
            process.kill()
            process.wait()
            process.stdout.close()
        for process in self.hand._started:
            process.kill()
            process.wait()


@pytest.fixture
def scene(tmp_path):
    found = Scene(tmp_path)
    yield found
    found.close()


def test_a_stopped_node_has_ended(scene):
    node = scene.node()
    found = scene.ask("stop", pid=node.pid, grace=10.0)
    assert (found.done, found.text) == (True, f"process {node.pid} ended on SIGINT")
    assert node.wait(WAIT_S) == -signal.SIGINT
    assert scene.ask("stop", pid=node.pid).text.endswith("had ended before")
    assert [one.kind for one in scene.announced] == ["stop", "stop"]


def test_a_restarted_node_runs_as_it_did(scene):
    node = scene.node()
    found = scene.ask("restart", pid=node.pid, grace=10.0)
    assert found.done, found.text
    pid = int(found.text.split()[-1])
    assert scene.printed() == f"{pid} {scene.folder}/work driver ['__name:=driver', 'a b']"
    assert os.getsid(pid) == pid
    again = record(pid)
    assert (again.words, again.program) == (scene.records.of(node.pid).words, scene.records.of(node.pid).program)


def test_a_node_that_hears_nothing_is_not_stopped_but_killed_by_who_may(scene):
    node = scene.node(deaf=True)
    found = scene.ask("stop", pid=node.pid, grace=0.2)
    assert (found.done, "is still there 0.2 s after" in found.text) == (False, True)
    assert not scene.ask("restart", pid=node.pid, grace=0.2, kill_after=0).done
    assert node.poll() is None
    found = scene.ask("restart", pid=node.pid, grace=0.2, kill_after=0.2)
    assert f"process {node.pid} was killed; started again as process" in found.text
    assert node.wait(WAIT_S) == -signal.SIGKILL


def test_a_frozen_node_is_killed(scene):
    node = scene.node()
    node.send_signal(signal.SIGSTOP)
    assert scene.ask("kill", pid=node.pid, grace=0.2).text == f"process {node.pid} was killed"


def test_a_node_that_is_gone_is_started_and_one_that_runs_is_left_alone(scene):
    node = scene.node()
    assert scene.ask("start", pid=node.pid).text == f"process {node.pid} runs already"
    node.kill()
    node.wait()
    found = scene.ask("start", pid=node.pid)
    assert found.text.startswith("started again as process")
    pid = found.text.split()[-1]
    assert scene.ask("start", pid=node.pid).text == f"another process started it again as process {pid}", (
        "not started twice"
    )


def test_a_process_that_only_a_monitor_takes_for_the_node_is_left_alone(scene):
    node = scene.node()
    found = scene.ask("kill", "/driver_of_another", pid=node.pid)
    assert (found.refused, "nothing on this host shows" in found.text) == (True, True)
    assert node.poll() is None


def test_nodes_that_share_a_process_are_left_alone(scene):
    node = scene.node()
    found = scene.ask("stop", pid=node.pid, beside=("/map", "/plan"))
    assert (found.done, "holds /map, /plan too" in found.text) == (False, True)
    assert node.poll() is None
    assert scene.ask("stop", pid=node.pid, beside=("/map",), whole_process=True, grace=10.0).done


@pytest.mark.parametrize(
    ("kind", "node", "arguments", "why"),
    [
        ("stop", "/arm", {}, "`stop` of /arm is not on the allow-list"),
        ("command", "", {"name": "reboot"}, "the command 'reboot' is not on the allow-list"),
        ("command", "", {"name": ["hello"]}, "is not on the allow-list"),
        ("publish", "/driver", {}, "is nothing that a host does"),
        ("../../x", "/driver", {}, "is nothing that a host does"),
    ],
)
def test_what_is_not_allowed_is_refused_and_not_announced(scene, kind, node, arguments, why):
    process = scene.node()
    found = scene.ask(kind, node, process.pid, **arguments)
    assert (found.done, found.refused) == (False, True)
    assert why in found.text
    assert not scene.announced
    assert process.poll() is None


def test_a_process_that_nobody_recorded_is_left_alone(scene):
    other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    found = scene.ask("kill", pid=other.pid)
    assert "was not recorded" in found.text
    assert not scene.ask("start", pid=0).done
    assert other.poll() is None
    other.kill()
    other.wait()


def test_a_process_of_two_nodes_is_started_again_once(scene):
    node = scene.node()
    node.kill()
    node.wait()
    for at, (name, other) in enumerate((("/driver", "/driver2"), ("/driver2", "/driver"))):
        scene.hand.begin(HostRequest(f"r/{at}.1", "restart", name, node.pid, (other,), {"whole_process": True}))
    found = [scene.reported.get(timeout=WAIT_S) for _ in range(2)]
    assert len(scene.hand._started) == 1
    (refused,) = [one for one in found if one.refused]
    assert "`restart` of /driver, which was begun before on process" in refused.text


def test_what_cannot_be_announced_is_not_done(scene):
    node = scene.node()
    scene.hand._announce = lambda _: 1 / 0
    found = scene.ask("stop", pid=node.pid)
    assert (found.refused, "could not be announced" in found.text) == (True, True)
    assert node.poll() is None


def test_a_hold_stops_what_is_asked_and_what_was_begun(scene):
    scene.held = "ann"
    node = scene.node()
    assert scene.ask("stop", pid=node.pid).text == "everything is held: ann"
    assert node.poll() is None


def test_commands_are_run_without_a_shell(scene):
    assert scene.ask("command", "", name="hello").text == "hello ended with 0: bye"
    assert scene.ask("command", "", name="fails").text.startswith("fails ended with 3")
    assert "did not end within 0.3 s" in scene.ask("command", "", name="slow").text


def test_a_command_line_that_is_wrong_by_now_is_told(scene):
    node = scene.node()
    (scene.folder / "work").rename(scene.folder / "moved")
    node.kill()
    node.wait()
    assert "cannot be started" in scene.ask("start", pid=node.pid).text
