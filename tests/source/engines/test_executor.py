import subprocess
import sys

import pytest

from roslens.source.engines.executor import InProcess, ProcessPool, executor_for

# Workers can only run what they can import: built-in functions serve as the work.


@pytest.mark.parametrize("executor", [InProcess(), ProcessPool(2)])
def test_an_error_is_a_result_and_the_others_go_on(executor):
    results = dict(executor.run(int, ["1", "2", "three", "4"]))
    assert isinstance(results.pop("three"), ValueError)
    assert results == {"1": 1, "2": 2, "4": 4}


def test_a_task_that_kills_its_worker_loses_only_itself():
    deadly = "__import__('os')._exit(9)"
    results = dict(ProcessPool(2).run(eval, ["1", deadly, "3", "4", "5"]))
    assert isinstance(results.pop(deadly), RuntimeError)
    assert results == {"1": 1, "3": 3, "4": 4, "5": 5}


def test_one_job_needs_no_process():
    assert isinstance(executor_for(1), InProcess)
    assert isinstance(executor_for(2), ProcessPool)


def test_no_more_workers_are_started_than_are_of_use():
    assert [executor_for(8, useful=useful).jobs for useful in (0, 1, 3, 20)] == [8, 1, 3, 8]
    assert isinstance(executor_for(1, useful=3), InProcess)


STARTED = """
import os, sys, threading
from roslens.source.engines.executor import ProcessPool

def imported(_):
    return os.getppid(), "xml.dom.minidom" in sys.modules

if __name__ == "__main__":
    import xml.dom.minidom
    threads = int(sys.argv[1])
    ended = threading.Event()
    for _ in range(threads):
        threading.Thread(target=ended.wait).start()
    ((_, (parent, found)),) = ProcessPool(2).run(imported, ["task"])
    ended.set()
    print(parent == os.getpid(), found)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a copy of a process may not run")
@pytest.mark.parametrize(("threads", "copied"), [(0, "True True"), (1, "False False")])
def test_workers_are_copies_unless_a_thread_may_hold_a_lock(tmp_path, threads, copied):
    script = tmp_path / "started.py"
    script.write_text(STARTED)
    done = subprocess.run(
        [sys.executable, script, str(threads)], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.strip() == copied
