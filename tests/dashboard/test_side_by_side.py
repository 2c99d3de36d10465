"""Work by several processes: everything is done once, errors come out, a process that is killed loses nothing."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from roslens.dashboard.side_by_side import FEWEST, each

TASKS = list(range(FEWEST + 7))

pytestmark = [
    # Copies of a process with threads are only as safe as what they do: here they write files.
    pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning"),
    pytest.mark.skipif(sys.platform != "linux", reason="other systems copy no processes"),
]


def writer(folder: Path) -> Callable[[int], None]:
    """Return work that notes in a file which process did it."""

    def write(task: int) -> None:
        with (folder / str(task)).open("a") as stream:
            stream.write(f"{os.getpid()}\n")

    return write


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_task_is_done_once(tmp_path: Path, jobs: int) -> None:
    assert sorted(each(writer(tmp_path), TASKS, jobs)) == TASKS
    done = {int(path.name): path.read_text().split() for path in tmp_path.iterdir()}
    assert sorted(done) == TASKS
    assert {len(by) for by in done.values()} == {1}
    assert (str(os.getpid()) in {one for by in done.values() for one in by}) == (jobs == 1)


def test_few_tasks_are_done_here(tmp_path: Path) -> None:
    few = TASKS[: FEWEST - 1]
    assert list(each(writer(tmp_path), few, 2)) == few
    assert (tmp_path / "0").read_text().split() == [str(os.getpid())]


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_error_comes_out(jobs: int) -> None:
    def fail(task: int) -> None:
        if task == 100:
            raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space left"):
        list(each(fail, TASKS, jobs))


def test_what_a_killed_process_was_at_is_done_here(tmp_path: Path) -> None:
    write, here = writer(tmp_path), os.getpid()

    def work(task: int) -> None:
        if task == 100 and os.getpid() != here:
            os.kill(os.getpid(), 9)
        write(task)

    assert sorted(each(work, TASKS, 2)) == TASKS
    assert sorted(int(path.name) for path in tmp_path.iterdir()) == TASKS
