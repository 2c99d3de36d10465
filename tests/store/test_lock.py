"""One writer at a time; readers are never in its way."""

import subprocess
import sys
import threading
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslens.model.errors import StoreError
from roslens.store.runs import Store

pytestmark = pytest.mark.timed

HOLDER = """
import importlib.util, sys
from pathlib import Path
from roslens.store.runs import Store
spec = importlib.util.spec_from_file_location("report_sample", sys.argv[2])
sample = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sample)
header = sample.header("key-of-other", "2024-05-03T08:00:00+00:00")
with Store.open(Path(sys.argv[1])) as store, store.writing(header) as writer:
    writer.add("unit-arm", sample.arm())
    print("holding", flush=True)
    if sys.stdin.readline() == "complete\\n":
        writer.complete(sample.workspace(), header)
        print("done", flush=True)
"""


@contextmanager
def other_writer(path, sample):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(path), sample.__file__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    with process:
        assert process.stdout.readline() == "holding\n"
        try:
            yield process
        finally:
            if process.poll() is None:
                process.kill()


@pytest.fixture
def path(tmp_path):
    return tmp_path / ".roslens" / "store.sqlite"


def test_the_second_writer_learns_who_the_first_is(path, sample, write_small):
    with Store.open(path) as store:
        write_small(store)
    with (
        other_writer(path, sample) as other,
        Store.open(path, wait_s=0.2) as store,
        pytest.raises(StoreError) as caught,
    ):
        write_small(store, "key-2")
    assert caught.value.what == (
        f"another run is writing to the store (process {other.pid}, started 2024-05-03T08:00:00+00:00)"
    )
    assert caught.value.where == str(path)
    assert caught.value.expected == "the store to be free within 0.2 s"
    assert "--no-store" in caught.value.advice


def test_old_runs_are_not_removed_while_a_run_is_written(path, sample, write_small):
    with Store.open(path) as store:
        write_small(store)
    with (
        other_writer(path, sample) as other,
        Store.open(path, wait_s=0) as store,
        pytest.raises(StoreError, match=rf"process {other.pid},"),
    ):
        store.prune(0)


def test_a_reader_sees_the_run_before(path, sample, write_small):
    with Store.open(path) as store:
        number = write_small(store)
    with other_writer(path, sample), Store.open(path, wait_s=0.2) as store:
        assert store.latest() == number
        assert store.run_with("key-of-other") is None
        assert len(list(store.view().findings())) == 3


def test_the_second_writer_waits_for_the_first(path, sample, write_small):
    with Store.open(path) as store:
        write_small(store)
    waiting = []
    with other_writer(path, sample) as other, Store.open(path, wait_s=60) as store:
        thread = threading.Thread(target=lambda: waiting.append(write_small(store, "key-2")))
        thread.start()
        other.stdin.write("complete\n")
        other.stdin.flush()
        assert other.stdout.readline() == "done\n"
        thread.join(60)
        assert [run.header.key for run in store.runs()] == ["key-2", "key-of-other", "key-1"]
        assert waiting == [store.latest()]


def test_who_waits_is_told_for_whom(path, sample, write_small):
    reported = []
    with Store.open(path) as store:
        write_small(store)
    with other_writer(path, sample) as other, Store.open(path, wait_s=60) as store:

        def waiting(who):
            reported.append(who)
            other.stdin.write("complete\n")
            other.stdin.flush()

        with store.writing(sample.header("key-2"), waiting):
            assert reported == [f"process {other.pid}, started 2024-05-03T08:00:00+00:00"]
        with store.writing(sample.header("key-2"), waiting):
            assert len(reported) == 1


def test_a_reader_of_a_store_without_runs_learns_that_the_first_is_being_made(path, sample):
    with Store.open(path) as store:
        with other_writer(path, sample) as other, pytest.raises(StoreError, match="is being made") as caught:
            store.view()
        assert f"(process {other.pid}, started 2024-05-03T08:00:00+00:00)" in caught.value.what
        assert "Wait" in caught.value.advice
        with pytest.raises(StoreError, match="Run `roslens check` first"):
            store.view()


def test_a_dead_writer_holds_nothing(path, sample, write_small):
    with other_writer(path, sample) as other:
        other.kill()
        other.wait()
    with Store.open(path, wait_s=0) as store:
        assert store.latest() is None
        assert not store.has_unit("unit-arm")
        assert store.view(write_small(store)).packages()


def test_many_make_the_store_at_once(path):
    start = threading.Barrier(8)
    failed = []

    def make():
        start.wait()
        try:
            with Store.open(path) as store:
                assert store.latest() is None
        except StoreError as error:
            failed.append(str(error))

    threads = [threading.Thread(target=make) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []


def test_processes_make_the_store_at_once(path):
    imports = "import sys; from pathlib import Path; from roslens.store.runs import Store"
    code = f"{imports}; Store.open(Path(sys.argv[1])).close()"
    processes = [
        subprocess.Popen([sys.executable, "-c", code, str(path)], stderr=subprocess.PIPE, text=True) for _ in range(4)
    ]
    for process in processes:
        assert process.communicate()[1] == ""
        assert process.returncode == 0
    assert Path(path).exists()
