"""Work on a cluster of Dask, which is two processes of this machine."""

import asyncio
import os
import socket
import subprocess
import sys
from contextlib import contextmanager

import pytest

from roslens.children.safe_path import safe_environment
from roslens.model.errors import UsageError
from roslens.source.engines import dask_engine
from roslens.source.engines.cluster_ahead import ClusterAhead
from roslens.source.engines.dask_engine import DaskEngine, _reaches_workers, _Standing
from roslens.source.engines.executor import InProcess, ProcessPool, executor_for
from roslens.source.engines.task_limits import TaskLimits

# Workers can only run what they can import: built-in functions serve as the work.

SCHEDULER = """
import asyncio
from distributed import Nanny, Scheduler

async def run():
    async with Scheduler(host="127.0.0.1", port=0, dashboard=False, allowed_failures=0) as scheduler:
        workers = [
            await Nanny(scheduler.address, nthreads=1, host="127.0.0.1", dashboard=False, memory_limit=0)
            for _ in range(int(sys.argv[1]))
        ]
        print(scheduler.address, flush=True)
        await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
        for worker in workers:
            await worker.close()

if __name__ == "__main__":
    asyncio.run(run())
"""


@contextmanager
def cluster(tmp_path, workers):
    """Lend the address of a scheduler with workers, and the process that is it."""
    script = tmp_path / "cluster.py"
    script.write_text("import sys\n" + SCHEDULER)
    words = [sys.executable, str(script), str(workers)]
    with subprocess.Popen(
        words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=tmp_path,
        env=safe_environment({**os.environ, "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False"}),
        start_new_session=True,
    ) as process:  # fmt: skip
        try:
            yield process.stdout.readline().strip(), process
        finally:
            os.killpg(process.pid, 9)


def engine(address, **more):
    return DaskEngine(address, rest=ProcessPool(1, more.get("limits")), **more)


def test_an_error_is_a_result_and_the_others_go_on(tmp_path):
    # In threads of this process, which has no limits then: a cluster of its own is in the tests of the night.
    distributed = pytest.importorskip("distributed")
    free = TaskLimits(seconds=0, memory_bytes=0)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", protocol="tcp://", host="127.0.0.1"
    ) as local:
        found = engine(local.scheduler_address, folder=str(tmp_path), limits=free)
        results = dict(found.run(int, ["1", "2", "three", "4"]))
        assert found.done_here == 0
        assert isinstance(results.pop("three"), ValueError)
        assert results == {"1": 1, "2": 2, "4": 4}
        with pytest.raises(UsageError, match='does not see "/nowhere"'):
            list(engine(local.scheduler_address, folder="/nowhere").run(int, ["1"]))


def test_results_that_went_with_a_lost_cluster_are_made_here(tmp_path, monkeypatch):
    distributed = pytest.importorskip("distributed")
    read = dask_engine._outcome
    lost = iter([asyncio.CancelledError(), ConnectionError("gone")])
    monkeypatch.setattr(dask_engine, "_outcome", lambda future: next(lost, None) or read(future))
    free = TaskLimits(seconds=0, memory_bytes=0)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", protocol="tcp://", host="127.0.0.1"
    ) as local:
        found = DaskEngine(local.scheduler_address, rest=InProcess(), folder=str(tmp_path), limits=free)
        assert dict(found.run(int, ["1", "2", "3", "4"])) == {"1": 1, "2": 2, "3": 3, "4": 4}
        assert found.done_here == 2


def test_a_cluster_is_connected_to_before_there_is_work(tmp_path):
    distributed = pytest.importorskip("distributed")
    free = TaskLimits(seconds=0, memory_bytes=0)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", protocol="tcp://", host="127.0.0.1"
    ) as local:
        ahead = ClusterAhead(local.scheduler_address, str(tmp_path), os.getpid)
        found = engine(ahead.address, connection=ahead.client, limits=free)
        assert dict(found.run(int, ["1", "2"])) == {"1": 1, "2": 2}
        assert found.done_here == 0
        unused = ClusterAhead(local.scheduler_address, str(tmp_path), os.getpid)
        unused.close()
        unused.thread.join()
        assert unused.client().status == "closed"
        blind = ClusterAhead(local.scheduler_address, "/nowhere", os.getpid)
        with pytest.raises(UsageError, match='does not see "/nowhere"'):
            list(engine(blind.address, connection=blind.client).run(int, ["1"]))


def test_a_cluster_that_is_gone_before_there_is_work(tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", protocol="tcp://", host="127.0.0.1"
    ) as local:
        ahead = ClusterAhead(local.scheduler_address, str(tmp_path), os.getpid)
        ahead.client().close()
        found = DaskEngine(ahead.address, rest=InProcess(), connection=ahead.client, patience_s=0.0)
        assert dict(found.run(int, ["1", "2"])) == {"1": 1, "2": 2}
        assert found.done_here == 2


class Fickle:
    """A client whose scheduler or workers are lost when it asks for the first time."""

    def __init__(self, status):
        self.status = status
        self.asked = 0

    def wait_for_workers(self, *_, **__):
        self.asked += 1
        if self.asked == 1:
            raise OSError("in <TCP>: Stream is closed")

    def run(self, function, *given):
        return {"a": function(*given)}

    def close(self, timeout):
        self.status = "closed"


def test_a_worker_that_is_lost_while_it_is_asked_is_no_fault_of_the_cluster(tmp_path, monkeypatch):
    client = Fickle("running")
    monkeypatch.setattr(dask_engine, "_connected", lambda *_: client)
    assert dask_engine.fit_client("tcp://a:1", str(tmp_path)) is client
    assert (client.asked, client.status) == (2, "running")


def test_a_scheduler_that_is_lost_while_it_is_asked_cannot_be_reached(tmp_path, monkeypatch):
    client = Fickle("connecting")
    monkeypatch.setattr(dask_engine, "_connected", lambda *_: client)
    with pytest.raises(UsageError, match=r"'tcp://a:1' cannot be reached: in <TCP>: Stream is closed"):
        dask_engine.fit_client("tcp://a:1", str(tmp_path))
    assert client.status == "closed"


def test_dask_prints_nothing_here():
    pytest.importorskip("distributed")
    words = """
import logging
from roslens.model.errors import UsageError
from roslens.source.engines.dask_engine import fit_client
try:
    fit_client("tcp://127.0.0.1:9", "", connect_s=0.2)
except UsageError:
    logging.getLogger("distributed.client").error("the scheduler is gone")
    logging.getLogger("tornado.application").error("a callback failed")
    print("done")
"""
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("done\n", "")


@pytest.mark.nightly
def test_a_task_that_ends_its_worker_loses_only_itself(tmp_path):
    deadly = "__import__('os')._exit(9)"
    slow = "__import__('time').sleep(60)"
    with cluster(tmp_path, 2) as (address, _):
        found = engine(address, limits=TaskLimits(seconds=3.0))
        results = dict(found.run(eval, ["1", deadly, "3", slow, *map(str, range(10, 30))]))
        assert "died twice" in str(results.pop(deadly))
        assert "which may take 3 s" in str(results.pop(slow))
        assert results == {text: int(text) for text in results}
        assert len(results) == 22
        assert found.done_here < 20


@pytest.mark.nightly
def test_a_task_that_takes_too_much_memory_is_an_error_of_its_own(tmp_path):
    with cluster(tmp_path, 1) as (address, _):
        found = engine(address, limits=TaskLimits(memory_bytes=1_000_000_000))
        results = dict(found.run(eval, ["len(bytearray(2_000_000_000))", "7"]))
        assert found.done_here == 0
        assert isinstance(results.pop("len(bytearray(2_000_000_000))"), MemoryError)
        assert results == {"7": 7}


@pytest.mark.nightly
def test_what_a_lost_cluster_leaves_is_done_here(tmp_path):
    tasks = [f"__import__('time').sleep(0.2) or {number}" for number in range(20)]
    with cluster(tmp_path, 2) as (address, process):
        found = engine(address, patience_s=3.0)
        results = {}
        for task, result in found.run(eval, tasks):
            results[task] = result
            if len(results) == 4:
                os.killpg(process.pid, 9)
        assert sorted(results.values()) == list(range(20))
        assert 0 < found.done_here <= 16


def test_a_scheduler_that_is_not_there():
    with pytest.raises(UsageError, match="cannot be reached"):
        list(engine("tcp://127.0.0.1:9", connect_s=0.2).run(int, ["1"]))


def test_results_come_straight_from_workers_that_can_be_reached():
    class Client:
        def __init__(self, *addresses):
            self.addresses = addresses

        def nthreads(self):
            return dict.fromkeys(self.addresses, 1)

    with socket.create_server(("127.0.0.1", 0)) as server:
        there = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        assert _reaches_workers(Client(there))
        assert not _reaches_workers(Client(there, "inproc://10.0.0.1/1/2"))
    assert not _reaches_workers(Client(there))


def test_a_cluster_is_asked_now_and_then_or_when_something_was_lost():
    class Client:
        status = "running"
        asked = 0

        def nthreads(self):
            self.asked += 1
            return {"a": 2} if self.asked < 3 else {}

    now = [0.0]
    client = Client()
    standing = _Standing(client, lambda: now[0])
    standing.look(at_once=False)
    assert (standing.threads, client.asked) == (2, 1)
    now[0] = 5.0
    standing.look(at_once=False)
    assert (standing.threads, client.asked, standing.absent_s) == (2, 2, 0)
    now[0] = 6.0
    standing.look(at_once=True)
    assert (standing.threads, client.asked, standing.absent_s) == (0, 3, 1.0)
    now[0] = 6.5
    standing.look(at_once=False)
    assert (client.asked, standing.absent_s) == (4, 1.5)


def test_no_engine_of_that_name():
    with pytest.raises(UsageError, match="tcp://host:8786"):
        executor_for(1, "spark")
    assert isinstance(executor_for(8, "in-process"), InProcess)
    assert isinstance(executor_for(8, "tcp://h:1"), DaskEngine)
