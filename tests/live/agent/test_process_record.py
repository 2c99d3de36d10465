import os
import subprocess
import sys

import pytest

from roslens.live.agent.process_record import ProcessRecords, names_node, record, started_ticks


@pytest.fixture
def process(tmp_path):
    words = [sys.executable, "-c", "print('up', flush=True); import time; time.sleep(60)", "x y", ""]
    found = subprocess.Popen(words, cwd=tmp_path, env={"A": "1=2", "B": ""}, stdout=subprocess.PIPE)
    found.stdout.readline()
    yield found
    found.kill()
    found.wait()
    found.stdout.close()


def test_a_process_is_recorded_as_it_was_started(process, tmp_path):
    found = record(process.pid)
    assert found.words == tuple(process.args)
    assert found.environment == {"A": "1=2", "B": ""}
    assert (found.folder, found.parent, found.supervisor) == (str(tmp_path), os.getpid(), "")
    assert found.user[:2] == (os.getuid(), os.getgid())


def test_what_is_kept_outlives_the_process(process):
    records = ProcessRecords()
    records.keep([process.pid, 2**22 + 5])
    kept = records.of(process.pid)
    assert records.alive(kept)
    process.kill()
    process.wait()
    assert not records.alive(kept)
    records.keep([process.pid])
    assert records.of(process.pid) is kept


def test_a_zombie_is_gone(process):
    process.kill()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    assert started_ticks(process.pid) is None


def test_only_so_many_are_kept_and_those_that_run_last(process):
    records = ProcessRecords(most=1)
    other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    records.keep([other.pid])
    other.kill()
    other.wait()
    records.keep([process.pid])
    assert records.of(other.pid) is None
    assert records.of(process.pid) is not None


def test_one_that_was_started_with_the_same_words_is_found(process, tmp_path):
    records = ProcessRecords()
    records.keep([process.pid])
    kept = records.of(process.pid)
    assert records.again(kept) == 0
    again = subprocess.Popen(process.args, cwd=tmp_path, stdout=subprocess.DEVNULL)
    while record(again.pid) is None or record(again.pid).words != kept.words:
        pass
    assert records.again(kept) in (again.pid, 0)
    again.kill()
    again.wait()


@pytest.mark.parametrize(
    ("words", "node", "named"),
    [
        (("node", "--ros-args", "-r", "__node:=cam"), "/front/cam", True),
        (("node", "-r", "__node:=cam", "-r", "__ns:=/front"), "/front/cam", True),
        (("node", "-r", "__node:=cam", "-r", "__ns:=/rear"), "/front/cam", False),
        (("node", "__name:=cam"), "/cam2", False),
        (("node", "cam"), "/cam", False),
    ],
)
def test_a_command_line_may_name_its_node(words, node, named):
    assert names_node(words, node) is named


def test_a_process_is_shown_to_be_a_node_by_what_counts_in_it(process):
    records = ProcessRecords()
    records.keep({process.pid: ()})
    kept = records.of(process.pid)
    assert not records.shows(kept, "/cam")
    records.keep({process.pid: ("/cam",)})
    records.keep([process.pid])
    assert records.shows(kept, "/cam")
    assert not records.shows(kept, "/arm")
